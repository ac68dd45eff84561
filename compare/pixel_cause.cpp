#include "compare/pixel_cause.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

/// The claim that follows from a counter and a triangle, where the light shines or not.
Visibility claim_of(const JudgedFrame& judged, std::int64_t count, std::uint32_t triangle,
                    bool in_cone) {
    if (triangle == no_triangle) return Visibility::background;
    const bool unshadowed = judged.receives[triangle] == 0 || judged.stored(count) == 0;
    const bool lit = in_cone && unshadowed && sides_of(judged.tracer, triangle).faces_light();
    return lit ? Visibility::lit : Visibility::shadowed;
}

/// Where faces in front of the surface are counted, and the counter does not begin with what is
/// lost of them.
std::optional<Cause> cause_at_near_plane(const Counting& counting, const Reading& reading) {
    switch (counting.start) {
    case Counting::Start::zero:
        return reading.at_eye != 0 ? Cause::eye_inside : Cause::near_plane;
    case Counting::Start::eye:
        return Cause::near_plane;
    case Counting::Start::near_plane:
        break;
    }
    return std::nullopt;
}

/// Why a technique that counted `reading` shows another claim than the truth, where its surface is
/// the true one. Nothing where the algorithm itself would be right.
std::optional<Cause> algorithmic_cause(const JudgedFrame& judged, const Reading& reading,
                                       Visibility true_visibility) {
    const bool counted_lit = judged.stored(reading.count) == 0;
    const bool ideally_lit = reading.ideal == 0;
    const bool truly_lit = true_visibility == Visibility::lit;
    if (counted_lit == truly_lit) return std::nullopt;
    // The counter tells what it ought to, and is still wrong: the mesh does not enclose a volume.
    if (counted_lit == ideally_lit && reading.count == reading.ideal)
        return truly_lit ? std::nullopt : std::optional(Cause::open_mesh);
    const Counting& counting = judged.frame.counting;
    if (counting.operation == Counting::Operation::saturate) return Cause::counter;
    if (counted_lit && reading.count != 0)
        return counting.operation == Counting::Operation::invert ? Cause::parity : Cause::counter;
    if (std::isfinite(counting.extrusion)) return Cause::extrusion;
    // Filled holes shadow what the open caster does not.
    if (counting.holes_filled && reading.count != reading.ideal) return Cause::open_mesh;
    if (!counting.light_cap) return Cause::cap;
    if (counting.test == Counting::Test::depth_pass) return cause_at_near_plane(counting, reading);
    if (judged.frame.depth_model.finite() && !counting.depth_clamp) return Cause::far_plane;
    if (!counting.dark_cap) return Cause::cap;
    return std::nullopt;
}

/// The reading at the pixel's centre, as traced.
Reading centre_reading(const JudgedFrame& judged, PixelPlace p) {
    const Image<std::uint8_t>& in_cone = judged.truth.in_cone;
    const ShadowDepths& ideal = judged.prediction.ideal_depths();
    return {judged.predicted(p), ideal.at_surface.at(p.x, p.y), ideal.at_eye,
            in_cone.pixels.empty() || in_cone.at(p.x, p.y) != 0, false};
}

/// Where read-back and prediction agree at the centre, the cause is the algorithm's own.
std::optional<Cause> cause_at_centre(const JudgedFrame& judged, PixelPlace p) {
    const Reading reading = centre_reading(judged, p);
    const std::uint32_t triangle = judged.truth.triangle.at(p.x, p.y);
    if (!judged.surface_as_true(p) || triangle == no_triangle) return std::nullopt;
    if (judged.stored(reading.count) != judged.read_back(p)) return std::nullopt;
    if (claim_of(judged, reading.count, triangle, reading.in_cone) !=
        judged.frame.claim.at(p.x, p.y))
        return std::nullopt;
    return algorithmic_cause(judged, reading, judged.truth.visibility.at(p.x, p.y));
}

} // namespace

bool settled(const JudgedFrame& judged, PixelPlace p, std::optional<Cause>& cause) {
    const bool counted =
        judged.surface_as_true(p) && judged.stored(judged.predicted(p)) == judged.read_back(p);
    if (!judged.differs(p)) return counted;
    cause = cause_at_centre(judged, p);
    return counted && cause.has_value();
}

bool explains(const JudgedFrame& judged, PixelPlace p, const Reading& reading) {
    return judged.stored(reading.count) == judged.read_back(p) &&
           claim_of(judged, reading.count, judged.frame.triangle.at(p.x, p.y), reading.in_cone) ==
               judged.frame.claim.at(p.x, p.y);
}

Cause cause_in_band(const JudgedFrame& judged, PixelPlace p, const PixelBand& band,
                    std::span<const RayTruth> around) {
    const Visibility claim = judged.frame.claim.at(p.x, p.y);
    if (const std::optional<Cause> cause = cause_at_centre(judged, p)) return *cause;
    if (std::any_of(around.begin(), around.end(),
                    [&](const RayTruth& t) { return t.visibility == claim; }))
        return Cause::edge;

    const std::uint32_t shown = judged.frame.triangle.at(p.x, p.y);
    // What is true of the surface shown, where it is seen next to the centre.
    const auto seen = std::find_if(around.begin(), around.end(),
                                   [&](const RayTruth& t) { return t.triangle == shown; });
    const Visibility truth_of_shown =
        seen != around.end() ? seen->visibility : judged.truth.visibility.at(p.x, p.y);
    std::optional<Cause> algorithmic;
    for (const Reading& reading : band.readings) {
        if (!explains(judged, p, reading)) continue;
        // What ought to be counted makes this claim, too, with faces moved in depth.
        if (reading.by_rounding && claim_of(judged, reading.ideal, shown, reading.in_cone) == claim)
            return Cause::precision;
        if (!algorithmic) algorithmic = algorithmic_cause(judged, reading, truth_of_shown);
    }
    return algorithmic.value_or(Cause::unexplained);
}

} // namespace shadowproof
