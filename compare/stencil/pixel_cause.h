// The cause of one differing pixel: why a technique shows another claim there than the truth.
#pragma once

#include "compare/driver/sufficient_depths.h"
#include "compare/judge/judge.h"
#include "compare/stencil/band.h"
#include "reference/predict/prediction.h"
#include "reference/trace/trace.h"
#include "scenes/cause.h"
#include "scenes/frame.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

/// A counted claim beside the truth and the prediction of its counters.
struct CountedClaim : JudgedClaim {
    const Prediction& prediction;
    std::vector<std::uint8_t> receives; ///< one flag per triangle
    SufficientDepths sufficient;        ///< of the technique's numbers

    const Tracer& tracer() const { return traced.tracer(); }
    const GroundTruth& truth() const { return traced.truth(); }
    const Counting& counting() const { return frame.counted->counting; }
    std::uint32_t stored(std::int64_t count) const {
        return shadowproof::stored(count, counting());
    }
    std::int64_t predicted(PixelPlace p) const { return prediction.counts().at(p.x, p.y); }
    std::uint32_t read_back(PixelPlace p) const { return frame.counted->counter.at(p.x, p.y); }
};

/// The claim that follows from a counter and a triangle, where the light shines or not.
Visibility claim_of(const CountedClaim& judged, std::int64_t count, std::uint32_t triangle,
                    bool in_cone);

/// Whether the pixel is decided at its centre, without its surroundings; `cause` is set if it
/// differs.
bool settled(const CountedClaim& judged, PixelPlace p, std::optional<PixelCause>& cause);

/// Whether a reading is what was read back, and leads to the claim that was made.
bool explains(const CountedClaim& judged, PixelPlace p, const Reading& reading);

/// The cause of a pixel that differs and is not settled. `truth`: what is true along its
/// neighbourhood's rays.
PixelCause cause_in_band(const CountedClaim& judged, PixelPlace p, const PixelBand& band,
                         const Neighbourhood& around, std::span<const RayTruth> truth);

} // namespace shadowproof
