#include "compare/stencil/pixel_cause.h"

#include "compare/stencil/counterfactual.h"
#include "compare/stencil/precision_check.h"

#include <algorithm>
#include <functional>

namespace shadowproof {

namespace {

/// The limitations to lift so that a technique that counted `count` claims the truth, where its
/// surface is the true one. `count_without`: what it counts without some of them. None if the
/// counter leads to the truth as it is, or if nothing mends it.
std::optional<Limitations>
algorithmic_cause(const CountedClaim& judged, std::int64_t count, Visibility true_visibility,
                  const std::function<std::int64_t(Limitations)>& count_without) {
    const bool truly_lit = true_visibility == Visibility::lit;
    if ((judged.stored(count) == 0) == truly_lit) return std::nullopt;
    return needed_lifts(judged.prediction.limitations(), [&](Limitations lifted) {
        const Counting& counting = judged.prediction.without(lifted).counting;
        return (stored(count_without(lifted), counting) == 0) == truly_lit;
    });
}

PixelCause needing(Limitations needed) {
    PixelCause cause{decisive_cause(needed), {}};
    for (const Limitation limitation : listed(needed))
        if (cause_of(limitation) != cause.cause) cause.also.add(cause_of(limitation));
    return cause;
}

/// Where read-back and prediction agree at the centre, the cause is the algorithm's own.
std::optional<PixelCause> cause_at_centre(const CountedClaim& judged, PixelPlace p) {
    const std::int64_t count = judged.predicted(p);
    const Image<std::uint8_t>& cones = judged.truth().in_cone;
    const bool in_cone = cones.pixels.empty() || cones.at(p.x, p.y) != 0;
    const std::uint32_t triangle = judged.truth().triangle.at(p.x, p.y);
    if (!judged.surface_as_true(p) || triangle == no_triangle) return std::nullopt;
    if (judged.stored(count) != judged.read_back(p)) return std::nullopt;
    if (claim_of(judged, count, triangle, in_cone) != judged.frame.claim.at(p.x, p.y))
        return std::nullopt;
    const auto needed = algorithmic_cause(
        judged, count, judged.truth().visibility.at(p.x, p.y),
        [&](Limitations lifted) { return judged.prediction.count_without(lifted, p.x, p.y); });
    if (!needed) return std::nullopt;
    return needing(*needed);
}

/// The same for a reading in the pixel's band; its difference from its own ray's faces is kept.
std::optional<PixelCause> cause_of_reading(const CountedClaim& judged, const Reading& reading,
                                           std::uint32_t shown, const Neighbourhood& around,
                                           Visibility true_visibility) {
    const SurfaceRay ray{reading.line, reading.depth, shown, around.corners};
    // Steps that a counter lost at its limits are not faces.
    const bool saturates = judged.counting().operation == Counting::Operation::saturate;
    const std::int64_t off_ray =
        saturates ? reading.off_ray : reading.count - judged.prediction.count_without({}, ray);
    // A plane that cuts nothing cuts nothing for being rounded, either.
    const auto by_clip = [&](Limitations lifted) {
        return (lifted.contains(Limitation::near_clip) ? reading.by_near : 0) +
               (lifted.contains(Limitation::far_clip) ? reading.by_far : 0);
    };
    const auto needed =
        algorithmic_cause(judged, reading.count, true_visibility, [&](Limitations lifted) {
            return off_ray - (saturates ? 0 : by_clip(lifted)) +
                   judged.prediction.count_without(lifted, ray);
        });
    if (!needed) return std::nullopt;
    return needing(*needed);
}

} // namespace

Visibility claim_of(const CountedClaim& judged, std::int64_t count, std::uint32_t triangle,
                    bool in_cone) {
    if (triangle == no_triangle) return Visibility::background;
    const bool unshadowed = judged.receives[triangle] == 0 || judged.stored(count) == 0;
    const bool lit = in_cone && unshadowed && sides_of(judged.tracer(), triangle).faces_light();
    return lit ? Visibility::lit : Visibility::shadowed;
}

bool settled(const CountedClaim& judged, PixelPlace p, std::optional<PixelCause>& cause) {
    const bool counted =
        judged.surface_as_true(p) && judged.stored(judged.predicted(p)) == judged.read_back(p);
    if (!judged.differs(p)) return counted;
    cause = cause_at_centre(judged, p);
    return counted && cause.has_value();
}

bool explains(const CountedClaim& judged, PixelPlace p, const Reading& reading) {
    return judged.stored(reading.count) == judged.read_back(p) &&
           claim_of(judged, reading.count, judged.frame.triangle.at(p.x, p.y), reading.in_cone) ==
               judged.frame.claim.at(p.x, p.y);
}

PixelCause cause_in_band(const CountedClaim& judged, PixelPlace p, const PixelBand& band,
                         const Neighbourhood& around, std::span<const RayTruth> truth) {
    const Visibility claim = judged.frame.claim.at(p.x, p.y);
    if (const std::optional<PixelCause> cause = cause_at_centre(judged, p)) return *cause;
    const SeenAround seen_so = seen_around(around, truth, claim);
    if (seen_so.truly) return {Cause::edge, {}};
    if (seen_so.by_planes) return {Cause::precision, {}};

    const std::uint32_t shown = judged.frame.triangle.at(p.x, p.y);
    const auto seen = std::find_if(truth.begin(), truth.end(),
                                   [&](const RayTruth& t) { return t.triangle == shown; });
    std::optional<PixelCause> algorithmic;
    bool precision = false;
    bool mended_exactly = false; // without rounding, whatever else would mend it
    bool by_depth = true;        // whatever else may have led to it
    bool mended_by_depth = true;
    for (const Reading& reading : band.readings) {
        if (!explains(judged, p, reading)) continue;
        const auto claim_by = [&](std::int64_t count) {
            return claim_of(judged, count, shown, reading.in_cone);
        };
        // The ideal count leads to this claim, too, with faces moved.
        if (reading.by_rounding && claim_by(reading.ideal) == claim) {
            precision = true;
            by_depth = by_depth && reading.by_depth;
            continue;
        }
        // The truth of the surface shown, where it is seen next to the centre; through a gap it is
        // seen on no ray.
        const Visibility truth_of_shown =
            seen != truth.end() ? seen->visibility : claim_by(reading.ideal);
        if (!algorithmic)
            algorithmic = cause_of_reading(judged, reading, shown, around, truth_of_shown);
        // What is seen only as the planes are rounded has no claim without that.
        if (!algorithmic && reading.by_rounding &&
            (reading.by_planes ||
             claim_by(judged.prediction.count_without(
                 {}, {reading.line, reading.depth, shown, around.corners})) == truth_of_shown)) {
            mended_exactly = true;
            mended_by_depth = mended_by_depth && reading.by_depth;
        }
    }
    if (precision) return {Cause::precision, {}, by_depth && is_too_near(judged, p)};
    if (mended_exactly && !algorithmic)
        return {Cause::precision, {}, mended_by_depth && is_too_near(judged, p)};
    return algorithmic.value_or(PixelCause{});
}

} // namespace shadowproof
