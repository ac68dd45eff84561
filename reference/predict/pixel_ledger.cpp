#include "reference/predict/pixel_ledger.h"

#include "reference/trace/faces.h"
#include "scenes/camera.h"

#include <limits>

namespace shadowproof {

namespace {

/// What the crossings listed add up to.
RayCounts sums(const Tracer& tracer, const PixelLedger& ledger, double far, std::uint32_t seen) {
    RayCounts sums;
    sums.at_eye = ledger.counts.at_eye;
    sums.at_near = sums.at_far = sums.at_surface = sums.at_infinity = sums.at_eye;
    for (const Crossing& crossing : ledger.crossings) {
        const bool own_cap =
            crossing.triangle == seen && crossing.part == Crossing::Part::light_cap;
        if (crossing.depth < tracer.scene().camera.near) sums.at_near += crossing.change;
        if (crossing.depth < ledger.surface && !own_cap) sums.at_surface += crossing.change;
        if (crossing.depth < far) sums.at_far += crossing.change;
        sums.at_infinity += crossing.change;
    }
    if (seen == no_triangle) sums.at_surface = 0;
    return sums;
}

double surface_depth(const Scene& scene, std::uint32_t seen, const glm::dvec3& line) {
    if (seen == no_triangle) return std::numeric_limits<double>::infinity();
    return depth_on_triangle(scene, seen, line);
}

} // namespace

void find_pixel_ledger(const Tracer& tracer, RegionLedger& region, const GroundTruth& truth,
                       const ShadowDepths& depths, int x, int y, PixelLedger& ledger) {
    const Scene& scene = tracer.scene();
    const glm::dvec3 direction = line_of_sight(scene.camera, x + 0.5, y + 0.5);
    const std::uint32_t seen = truth.triangle.at(x, y);
    ledger.counts = {depths.at_eye, depths.at_near.at(x, y), depths.at_surface.at(x, y),
                     depths.at_far.at(x, y), depths.at_infinity.at(x, y)};
    ledger.surface = surface_depth(scene, seen, direction);
    region.crossings(direction, ledger.crossings);
    ledger.adds_up = sums(tracer, ledger, depths.far, seen) == ledger.counts;
}

PixelLedger pixel_ledger(const Tracer& tracer, const GroundTruth& truth, const ShadowDepths& depths,
                         int x, int y) {
    const Silhouette silhouette(tracer);
    RegionLedger region(tracer, silhouette,
                        corner_lines(tracer.scene().camera, x, y, x + 1, y + 1));
    PixelLedger ledger;
    find_pixel_ledger(tracer, region, truth, depths, x, y, ledger);
    return ledger;
}

} // namespace shadowproof
