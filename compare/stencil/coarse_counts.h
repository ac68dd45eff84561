// What a counter may hold where float roundings move what is drawn by more than snapping does, so
// that rays next to the pixel do not suffice: bounds from all triangles and all faces of volumes,
// each with its own error.
#pragma once

#include "compare/stencil/pixel_cause.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shadowproof {

/// Sums of steps.
struct StepSums {
    std::int64_t low = 0;
    std::int64_t high = 0;
    std::int64_t up = 0; ///< of all steps up

    StepSums& operator+=(const StepSums& other);
};

struct CoarseCount {
    /// Some triangle or face that may cover the pixel, or not, is off by more than the pixel's
    /// neighbourhood is wide, or a dark cap at infinity may come out in front of what is shown.
    /// Where there is none, the neighbourhood gives tighter bounds.
    bool is_coarse = false;
    bool may_be_seen = true;           ///< what the pixel shows may be what is seen there
    StepSums counter;                  ///< before it wraps
    std::vector<std::uint32_t> tied{}; ///< as SurfaceChance has them

    /// Whether a buffer may hold `read` then.
    bool may_hold(std::uint32_t read, const Counting& counting) const;
};

/// Of pixels, each with how far aside the rasterizer may draw there. Time is linear in pixels times
/// faces.
std::vector<CoarseCount> coarse_counts(const CountedClaim& judged,
                                       std::span<const PixelPlace> places,
                                       std::span<const double> reach);

/// What a pixel's count explains: the claim must follow from a counter that the faces may lead to,
/// or from the one that was explained already: by another triangle of the same depth, or by a
/// spot's cone, on whose side the surface's interpolated position does not decide. `so_far`: what
/// else was found, which stays where this explains nothing.
Finding finding_by_all_faces(const CountedClaim& judged, PixelPlace p, const CoarseCount& count,
                             const Finding& so_far);

} // namespace shadowproof
