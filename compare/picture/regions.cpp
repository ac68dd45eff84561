#include "compare/picture/regions.h"

#include "compare/words.h"
#include "scenes/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace shadowproof {

namespace {

struct Spot {
    int x = 0;
    int y = 0;
};
using Spots = std::vector<Spot>;

/// The region around a pixel, whose flags are taken away.
Spots taken_region(const Image<Visibility>& claim, Image<std::uint8_t>& flags, Spot first) {
    Spots region{first};
    flags.at(first.x, first.y) = 0;
    for (std::size_t next = 0; next < region.size(); ++next) {
        const auto [x, y] = region[next];
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, flags.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, flags.width - 1); ++u) {
                if (flags.at(u, v) == 0 || claim.at(u, v) != claim.at(x, y)) continue;
                flags.at(u, v) = 0;
                region.push_back({u, v});
            }
    }
    return region;
}

/// The name that was counted most often; empty where none was.
std::string most_frequent(const std::map<std::uint32_t, std::uint64_t>& counts,
                          const Scene& scene) {
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? std::string() : scene.meshes[most->first].name;
}

/// Of a region's pixels, so many are asked what shadows them: more would name no other caster.
constexpr std::size_t most_asked = 256;

std::string caster_of(const TracedScene& traced, const Spots& spots) {
    const Scene& scene = traced.scene();
    std::map<std::uint32_t, std::uint64_t> casters;
    const std::size_t step = std::max<std::size_t>(1, spots.size() / most_asked);
    for (std::size_t i = 0; i < spots.size(); i += step) {
        const std::uint32_t occluder = occluder_of(
            traced.tracer(), line_of_sight(scene.camera, spots[i].x + 0.5, spots[i].y + 0.5));
        if (occluder != no_triangle) ++casters[mesh_of(scene, occluder)];
    }
    return most_frequent(casters, scene);
}

WrongRegion described(const TracedScene& traced, const Frame& frame, const Spots& spots) {
    const Scene& scene = traced.scene();
    WrongRegion region{.pixels = spots.size(),
                       .left = spots.front().x,
                       .top = spots.front().y,
                       .right = spots.front().x,
                       .bottom = spots.front().y};
    std::map<std::uint32_t, std::uint64_t> receivers;
    for (const auto [x, y] : spots) {
        region.left = std::min(region.left, x);
        region.right = std::max(region.right, x);
        region.top = std::min(region.top, y);
        region.bottom = std::max(region.bottom, y);
        ++receivers[mesh_of(scene, traced.truth().triangle.at(x, y))];
    }
    region.receiver = most_frequent(receivers, scene);
    const bool is_lit = frame.claim.at(spots.front().x, spots.front().y) == Visibility::lit;
    if (is_lit) region.caster = caster_of(traced, spots);
    const std::string what =
        !is_lit ? fmt::format("{} is shadowed where nothing is between it and the light",
                              region.receiver)
        : region.caster.empty()
            ? fmt::format("{} is lit where the light does not reach", region.receiver)
            : fmt::format("the shadow of {} on {} is lit", region.caster, region.receiver);
    region.words = fmt::format("{} from ({},{}) to ({},{}): {}", counted(region.pixels, "pixel"),
                               region.left, region.top, region.right, region.bottom, what);
    return region;
}

} // namespace

std::vector<WrongRegion> largest_regions(const TracedScene& traced, const Frame& frame,
                                         const Image<std::uint8_t>& flags, std::size_t most) {
    Image<std::uint8_t> rest = flags;
    std::vector<Spots> regions;
    for (int y = 0; y < rest.height; ++y)
        for (int x = 0; x < rest.width; ++x)
            if (rest.at(x, y) != 0) regions.push_back(taken_region(frame.claim, rest, {x, y}));
    std::stable_sort(regions.begin(), regions.end(),
                     [](const Spots& a, const Spots& b) { return a.size() > b.size(); });
    if (regions.size() > most) regions.resize(most);
    std::vector<WrongRegion> found;
    for (const Spots& spots : regions) found.push_back(described(traced, frame, spots));
    return found;
}

} // namespace shadowproof
