#include "compare/picture/map_ends.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A pixel that would be wrong outside the map.
struct MapPixel {
    glm::dvec3 place{0, 0, 0};
    bool is_shown = false; ///< the picture shows the truth: the map reaches it
};

std::vector<MapPixel> pixels_of(const Trial& trial, const LightAxes& axes, Visibility truly) {
    const Image<Visibility>& truth = trial.truth().visibility;
    std::vector<MapPixel> pixels;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x)
            if (truth.at(x, y) == truly && trial.is_decidable(x, y))
                pixels.push_back({place_from_light(chosen_light(trial.scene()), axes,
                                                   seen_point(trial.traced(), x, y)),
                                  trial.frame().claim.at(x, y) == truly});
    return pixels;
}

struct BoxEnd {
    int axis = 0;
    double sign = 1; ///< 1: the upper one; -1: the lower

    double& of(LightFrustum& box) const { return (sign > 0 ? box.high : box.low)[axis]; }
};

/// In the order in which they are looked for: on a floor, one may explain much of what another
/// does. The map of a spot holds its cone, and has a far plane; that of a directional light is a
/// square somewhere, deep enough.
std::array<BoxEnd, 5> box_ends(const Light& light) {
    if (light.kind == Light::Kind::spot) return {{{2, 1}, {0, 1}, {0, -1}, {1, 1}, {1, -1}}};
    return {{{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}}};
}

/// Pixels beyond the ends that are wrong, less those that are not.
std::int64_t explained_by(const std::vector<MapPixel>& pixels, const LightFrustum& box) {
    std::int64_t score = 0;
    for (const MapPixel& pixel : pixels)
        if (!box.holds(pixel.place)) score += pixel.is_shown ? -1 : 1;
    return score;
}

/// Sets one end so that it explains most of what the others do not.
void fit_end(const std::vector<MapPixel>& pixels, LightFrustum& box, const BoxEnd& end) {
    end.of(box) = end.sign * infinity;
    std::vector<std::pair<double, std::int64_t>> outwards; // farthest out first
    for (const MapPixel& pixel : pixels)
        if (box.holds(pixel.place))
            outwards.emplace_back(end.sign * pixel.place[end.axis], pixel.is_shown ? -1 : 1);
    std::sort(outwards.begin(), outwards.end(), std::greater<>());
    std::int64_t score = 0;
    std::int64_t best = 0;
    for (std::size_t i = 0; i + 1 < outwards.size(); ++i) {
        score += outwards[i].second;
        if (score <= best) continue;
        best = score;
        end.of(box) = end.sign * (outwards[i].first + outwards[i + 1].first) / 2;
    }
}

/// Leaves out each end that explains less than so many pixels that the others do not.
void drop_ends(const std::vector<MapPixel>& pixels, std::span<const BoxEnd> ends,
               std::int64_t least, LightFrustum& box) {
    for (const BoxEnd& end : ends) {
        LightFrustum without = box;
        end.of(without) = end.sign * infinity;
        if (explained_by(pixels, box) - explained_by(pixels, without) < least) box = without;
    }
}

} // namespace

std::optional<LightFrustum> fitted_frustum(const Trial& trial) {
    constexpr std::int64_t tips = 16;
    constexpr int rounds = 4; // each end again, now that the others are known
    const std::int64_t least = std::max(tips, static_cast<std::int64_t>(trial.wrong() / 20));
    std::optional<LightFrustum> best;
    std::int64_t best_score = least - 1;
    const Light& light = chosen_light(trial.scene());
    const std::array<BoxEnd, 5> ends = box_ends(light);
    for (const Visibility outside : {Visibility::lit, Visibility::shadowed})
        for (const LightAxes& axes : usual_axes(light)) {
            const std::vector<MapPixel> pixels = pixels_of(
                trial, axes, outside == Visibility::lit ? Visibility::shadowed : Visibility::lit);
            LightFrustum box{axes, outside};
            for (int round = 0; round < rounds; ++round)
                for (const BoxEnd& end : ends) fit_end(pixels, box, end);
            drop_ends(pixels, ends, least, box);
            const std::int64_t score = explained_by(pixels, box);
            if (score <= best_score) continue;
            best = box;
            best_score = score;
        }
    return best;
}

} // namespace shadowproof
