// The cause of one differing pixel: why a technique shows another claim there than the truth.
#pragma once

#include "compare/band.h"
#include "reference/prediction.h"
#include "reference/trace.h"
#include "scenes/cause.h"
#include "scenes/frame.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

struct PixelPlace {
    int x = 0;
    int y = 0;
};

/// A technique's frame beside the truth, the prediction of its counters, and what both are made of.
struct JudgedFrame {
    const Tracer& tracer;
    const Silhouette& silhouette;
    const GroundTruth& truth;
    const ShadowDepths& depths;
    const Frame& frame;
    const Prediction& prediction;
    std::vector<std::uint8_t> receives; ///< a flag a triangle

    std::uint32_t stored(std::int64_t count) const {
        return shadowproof::stored(count, frame.counting);
    }
    std::int64_t predicted(PixelPlace p) const { return prediction.counts().at(p.x, p.y); }
    std::uint32_t read_back(PixelPlace p) const { return frame.counter.at(p.x, p.y); }
    bool surface_as_true(PixelPlace p) const {
        return frame.triangle.at(p.x, p.y) == truth.triangle.at(p.x, p.y);
    }
    bool differs(PixelPlace p) const {
        return frame.claim.at(p.x, p.y) != truth.visibility.at(p.x, p.y);
    }
};

/// Whether the pixel needs no look at its surroundings; with its cause if it differs.
bool settled(const JudgedFrame& judged, PixelPlace p, std::optional<Cause>& cause);

/// Whether a reading is what was read back, and leads to the claim that was made.
bool explains(const JudgedFrame& judged, PixelPlace p, const Reading& reading);

/// Of a pixel that differs and is not settled. `around`: what is true along its neighbourhood's
/// rays.
Cause cause_in_band(const JudgedFrame& judged, PixelPlace p, const PixelBand& band,
                    std::span<const RayTruth> around);

} // namespace shadowproof
