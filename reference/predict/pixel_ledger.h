// The ledger of one pixel: which volume faces its eye ray crosses, and what the exact counts say.
#pragma once

#include "reference/predict/ledger.h"
#include "reference/predict/region_ledger.h"
#include "reference/trace/trace.h"

#include <vector>

namespace shadowproof {

/// Shadow depths along one eye ray, exact.
struct RayCounts {
    std::int32_t at_eye = 0;
    std::int32_t at_near = 0;
    std::int32_t at_surface = 0; ///< just before the seen surface; 0 at background
    std::int32_t at_far = 0;
    std::int32_t at_infinity = 0;
    bool operator==(const RayCounts&) const = default;
};

struct PixelLedger {
    std::vector<Crossing> crossings; ///< by depth from the eye on
    RayCounts counts;
    double surface = 0;   ///< view depth of the seen triangle; infinite: background
    bool adds_up = false; ///< the crossings' sums are the exact counts; else rounding moved some
};

/// Sets `ledger` to that at a pixel's centre. `region` must hold its ray.
void find_pixel_ledger(const Tracer& tracer, RegionLedger& region, const GroundTruth& truth,
                       const ShadowDepths& depths, int x, int y, PixelLedger& ledger);

/// The same for a pixel alone.
PixelLedger pixel_ledger(const Tracer& tracer, const GroundTruth& truth, const ShadowDepths& depths,
                         int x, int y);

} // namespace shadowproof
