// Each differing pixel gets its cause, and a cause is named only where it was predicted.
#pragma once

#include "compare/color_check.h"
#include "reference/prediction.h"
#include "reference/trace.h"
#include "scenes/cause.h"
#include "scenes/frame.h"

#include <array>
#include <cstdint>
#include <optional>

namespace shadowproof {

/// Values of Comparison::cause where there is no cause to name.
inline constexpr std::uint8_t no_difference = 0xff;

struct FirstDifference {
    int x = 0;
    int y = 0;
    Cause cause = Cause::unexplained;
};

/// The counter predicted against the counter read back, at every pixel. A surface that no
/// rasterizer would show there (surface_check.h) leaves the pixel unexplained, whatever its
/// counter.
struct LedgerCheck {
    std::uint64_t equal = 0;       ///< at the pixel's centre
    std::uint64_t in_band = 0;     ///< equal to a value inside the pixel's band
    std::uint64_t unexplained = 0; ///< neither; always a failure
    int first_x = 0;               ///< the first unexplained, in rows from the top
    int first_y = 0;
};

struct Comparison {
    Image<std::uint8_t> cause;       ///< Cause, or no_difference
    Image<std::uint8_t> ledger_miss; ///< 1 where the pixel is LedgerCheck::unexplained
    Image<std::uint32_t> predicted;  ///< the counter predicted at the centre, as stored
    std::array<std::uint64_t, all_causes.size()> causes{}; ///< pixels by cause
    std::uint64_t differing = 0;
    /// First in rows from the top; a pixel whose cause is worst (unexplained, then any but edge,
    /// then edge) is preferred.
    std::optional<FirstDifference> first;
    LedgerCheck ledger;
    std::optional<ColorCheck> colors; ///< where the frame has some
};

/// All pictures must have one size (asserted). `prediction`: of how the frame counts. Where
/// thousands of pixels are unexplained, further ones are compared at their centres only, so that
/// some of those may lie in their bands after all.
Comparison classify(const Tracer& tracer, const Silhouette& silhouette, const GroundTruth& truth,
                    const ShadowDepths& depths, const Frame& frame, const Prediction& prediction);

} // namespace shadowproof
