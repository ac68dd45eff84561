#include "compare/stencil/strain.h"

#include "compare/driver/error_bounds.h"
#include "compare/judge/depends_on_shadow.h"
#include "compare/judge/normal_distribution.h"
#include "reference/parallel.h"
#include "reference/trace/places.h"
#include "reference/trace/view.h"
#include "scenes/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Standard deviation of a sum of so many roundings for each of two faces, over its bound.
double deviation_share(int roundings) {
    return deviation_of_rounding / std::sqrt(2.0 * roundings);
}

/// Of a pixel, below which it is left out: those of 4096x4096 pixels add up to less than 0.017, and
/// a technique is derived to break from log 2 on.
constexpr double least_chance = 1e-9;

/// The chance that a surface, off by a normal error along its ray, has another claim there: at all
/// places where the shadow depth is 0 and should not be, or the other way round. The surface's own
/// light cap, and those of triangles with the same corners, are drawn with the same depths.
/// `inside`: the shadow depth at the surface.
double chance_of_error(const Scene& scene, const std::vector<Crossing>& crossings,
                       std::uint32_t seen, double depth, std::int32_t inside, double deviation) {
    const auto counts = [&](const Crossing& crossing) {
        return crossing.part != Crossing::Part::light_cap ||
               crossing.triangle >= scene.triangles.size() ||
               !have_same_corners(corners(scene, crossing.triangle), corners(scene, seen));
    };
    const bool lit = inside == 0;
    double chance = 0;
    const auto walk = [&](auto first, auto last, int direction) {
        std::int32_t there = inside;
        double since = 0;
        for (auto it = first; it != last; ++it) {
            if (!counts(*it)) continue;
            const double distance = direction * (it->depth - depth);
            if ((there == 0) != lit)
                chance += share_beyond(since, deviation) - share_beyond(distance, deviation);
            there += direction * it->change;
            since = distance;
        }
        if ((there == 0) != lit) chance += share_beyond(since, deviation);
    };
    const auto behind = std::ranges::lower_bound(crossings, depth, {}, &Crossing::depth);
    walk(behind, crossings.end(), 1);
    walk(std::make_reverse_iterator(behind), crossings.rend(), -1);
    return chance;
}

/// A pixel and the chance that its claim is wrong, wherever else its truth lies.
struct Strained {
    double chance = 0; ///< infinite: it is
    PixelPlace place{};
    glm::dvec3 point{0, 0, 0};
};

Strained strained_at(const CountedClaim& judged, PixelPlace p, RegionLedger& ledger,
                     std::vector<Crossing>& crossings) {
    const GroundTruth& truth = judged.truth();
    const Scene& scene = judged.traced.scene();
    const glm::dvec3 line = line_of_sight(scene.camera, p.x + 0.5, p.y + 0.5);
    const double depth = truth.depth.at(p.x, p.y);
    const glm::dvec3 point = point_on(scene.camera, line, depth);
    const bool lit = truth.visibility.at(p.x, p.y) == Visibility::lit;
    if ((judged.stored(judged.predicted(p)) == 0) != lit) return {infinity, p, point};
    ledger.crossings(line, crossings);
    const DepthModel& model = judged.frame.depth_model;
    const double deviation = std::hypot(
        deviation_share(window_depth_roundings) * stored_depth_error(model, depth),
        deviation_share(transform_roundings) * transform_depth_error(scene, model, point));
    const std::int32_t inside = judged.prediction.depths().at_surface.at(p.x, p.y);
    return {
        chance_of_error(scene, crossings, truth.triangle.at(p.x, p.y), depth, inside, deviation), p,
        point};
}

/// Those whose claims depend on counters, and that are not certainly right.
std::vector<Strained> strained_pixels(const CountedClaim& judged) {
    const Camera& camera = judged.traced.scene().camera;
    const int columns = (camera.width + region_side - 1) / region_side;
    const int rows = (camera.height + region_side - 1) / region_side;
    std::vector<std::vector<Strained>> by_region(static_cast<std::size_t>(columns) *
                                                 static_cast<std::size_t>(rows));
    parallel_for(columns * rows, judged.tracer().threads(), [&](int region, int) {
        const int left = region % columns * region_side;
        const int top = region / columns * region_side;
        const int right = std::min(left + region_side, camera.width);
        const int bottom = std::min(top + region_side, camera.height);
        RegionLedger ledger =
            judged.prediction.volumes().ledger(corner_lines(camera, left, top, right, bottom));
        std::vector<Crossing> crossings;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                if (!depends_on_shadow(judged.traced, {x, y})) continue;
                const Strained pixel = strained_at(judged, {x, y}, ledger, crossings);
                if (pixel.chance > least_chance)
                    by_region[static_cast<std::size_t>(region)].push_back(pixel);
            }
    });
    std::vector<Strained> all;
    for (const std::vector<Strained>& some : by_region)
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

/// Rays as far aside of the pixel's centre as the driver may draw.
std::array<glm::dvec3, 4> rays_aside(const CountedClaim& judged, const Strained& pixel) {
    const Scene& scene = judged.traced.scene();
    const double aside = lateral_error(scene, judged.frame.depth_model, pixel.point);
    const double x = pixel.place.x + 0.5;
    const double y = pixel.place.y + 0.5;
    return corner_lines(scene.camera, x - aside, y - aside, x + aside, y + aside);
}

} // namespace

double strain(const CountedClaim& judged) {
    const std::vector<Strained> pixels = strained_pixels(judged);
    std::vector<glm::dvec3> rays;
    for (const Strained& pixel : pixels)
        for (const glm::dvec3& ray : rays_aside(judged, pixel)) rays.push_back(ray);
    const std::vector<RayTruth> truths = trace_rays(judged.tracer(), rays);
    double expected = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const PixelPlace p = pixels[i].place;
        const Visibility own = judged.truth().visibility.at(p.x, p.y);
        if (std::ranges::all_of(std::span(truths).subspan(4 * i, 4),
                                [&](const RayTruth& t) { return t.visibility == own; }))
            expected += pixels[i].chance;
    }
    return expected / std::numbers::ln2;
}

} // namespace shadowproof
