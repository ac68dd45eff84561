// Why a traced pixel is wrong although its rays are as they must be: found by tracing exactly the
// very rays that were shot, and others in which one limitation is lifted.
#pragma once

#include "compare/traced/ray_check.h"

#include <optional>
#include <vector>

namespace shadowproof {

/// A triangle that a ray meets exactly.
struct ExactHit {
    std::uint32_t triangle = no_triangle;
    double t = 0;        ///< rounded
    bool is_own = false; ///< it is the receiver's own surface, as below
};

/// The rays of a pixel, traced exactly.
struct ExactRays {
    std::uint32_t seen = no_triangle; ///< what the eye ray that was shot meets first
    /// What is true where the eye ray that was shot meets the triangle that it was said to see.
    Visibility there = Visibility::background;
    std::uint32_t between = no_triangle; ///< a true occluder there
    std::vector<ExactHit> hits;          ///< of the shadow ray that was shot, nearest first
    /// Where the shadow ray that was shot comes through its receiver's plane from behind: hits up
    /// to there are on the surface that it started below.
    std::optional<double> leaves_at;
    /// A true occluder that the ray would have met with a smaller epsilon or offset, and where.
    std::optional<ExactHit> passed_over;
};

ExactRays trace_exactly(const TracedClaim& claim, PixelPlace p);

/// Of a pixel whose claim differs from the truth and follows from its rays. In this order:
///
/// missed: answered exactly, the rays that were shot give the truth.
/// acne: at the exact hit point the truth is lit, and the shadow ray meets the receiver's own
///     surface: the receiver itself, a neighbour that shares a corner with it, or what lies between
///     its start and the receiver's plane, where it starts behind that. A larger epsilon mends it.
/// leak: at the exact hit point the truth is shadowed, and a smaller epsilon or offset lets the
///     shadow ray meet an occluder that is truly there. Or it is lit, and without the offset the
///     ray meets nothing: the offset took it into something else.
/// precision: the rays are rounded: at the exact hit point the truth is otherwise, or a true
///     occluder is met by the exact segment and passed by the rounded ray, or the reverse.
PixelCause cause_of_rays(const TracedClaim& claim, PixelPlace p);

} // namespace shadowproof
