// Gives each differing pixel a cause. A cause is named only where it was predicted.
#pragma once

#include "compare/color/color_check.h"
#include "compare/judge/judge.h"
#include "scenes/cause.h"
#include "scenes/frame.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace shadowproof {

struct FirstDifference {
    int x = 0;
    int y = 0;
    Cause cause = Cause::unexplained;
};

/// Totals over a claim's shares of light.
struct ShareFigures {
    std::uint64_t partly_lit = 0; ///< pixels
    double wrongness = 0; ///< sum of wrongness() over all pixels that differ, except those of edge
};

struct Comparison {
    Image<std::uint8_t> cause; ///< Cause, or no_difference
    /// CauseSet::bits of further limitations that must be lifted together with `cause` to make the
    /// pixel right; empty if no pixel has any.
    Image<std::uint32_t> also;
    std::uint64_t several = 0;         ///< pixels with such further causes
    std::uint64_t too_near = 0;        ///< pixels with PixelCause::too_near
    Image<std::uint8_t> evidence_miss; ///< 1 where the pixel is EvidenceCheck::unexplained
    std::array<std::uint64_t, all_causes.size()> causes{}; ///< pixels by cause
    std::uint64_t differing = 0;
    /// The first, in rows from the top, of the pixels with the worst cause: unexplained, then any
    /// but edge, then edge.
    std::optional<FirstDifference> first;
    std::string evidence_name; ///< Judge::evidence
    EvidenceCheck evidence;
    EvidenceSummary summary;            ///< figures of the evidence
    std::optional<ColorCheck> colors;   ///< if the frame has colours
    std::optional<ShareFigures> shares; ///< if the frame has shares of light
};

inline std::uint64_t pixels_of(const Comparison& comparison, Cause cause) {
    return comparison.causes[static_cast<std::size_t>(cause)];
}

/// How wrong a claim is at a pixel that differs, given by its index: by a share of the light where
/// the claim is partly lit; by 1 elsewhere, and where the truth is background.
double wrongness(const Image<Visibility>& truth, const Frame& frame, std::size_t pixel);

/// All pictures must have the same size (asserted). `judge`: the frame's (judge_of). Where hardly
/// any pixel is explained, or thousands are not, those that are not decided at their centres are
/// not looked at any more: some of those that then count as unexplained may be explained within
/// their bands.
Comparison classify(const TracedScene& traced, const Frame& frame, const Judge& judge);

/// What is found at one pixel.
struct PixelFinding {
    std::uint8_t cause = no_difference; ///< Cause, or no_difference
    CauseSet also{};                    ///< as in Comparison::also
    bool too_near = false;              ///< as PixelCause has it
    bool unexplained = false;           ///< evidence or surface: see EvidenceCheck::unexplained
};

/// Classifies the pixel (x, y) alone, always within its band, even in a frame where classify
/// gives that up.
PixelFinding classify_pixel(const TracedScene& traced, const Frame& frame, const Judge& judge,
                            int x, int y);

} // namespace shadowproof
