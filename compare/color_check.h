// Colours, judged where truth and technique agree on surface and visibility: how far they are from
// the truth, whether that is within what rounding explains, and whether it is what the technique's
// own arithmetic should have left.
#pragma once

#include "compare/lighting_arithmetic.h"
#include "reference/trace.h"
#include "scenes/frame.h"

#include <cstdint>

namespace shadowproof {

/// Of a pixel's colour.
enum class ColorVerdict : std::uint8_t {
    not_judged,  ///< background, or surface or visibility are not the truth's
    within,      ///< the bound
    beyond,      ///< the bound; foreseen by the technique's arithmetic
    unforeseen,  ///< by it, within the bound or beyond
    unexplained, ///< beyond the bound, and unforeseen
};

struct ColorCheck {
    ColorModel model;            ///< how the technique made them
    Image<float> error;          ///< largest of the channels' differences, in steps of 1/255
    Image<ColorVerdict> verdict; ///< of every pixel
    std::uint64_t judged = 0;
    double largest = 0;           ///< difference of a channel, in steps of 1/255; here and below
    int largest_x = 0;            ///< where: the first in rows from the top
    int largest_y = 0;            ///< "
    double rmse = 0;              ///< over the channels of all judged pixels
    double percentile999 = 0;     ///< 99.9 % of the judged pixels' errors are no larger
    std::uint64_t beyond = 0;     ///< pixels by verdict
    std::uint64_t unforeseen = 0; ///< with those that are unexplained
    std::uint64_t moved = 0; ///< pixels that hold only if the rasterizer's lateral freedom counts
    int first_unforeseen_x = 0;
    int first_unforeseen_y = 0;
};

/// The frame must have colours, and the scene be bump-lit.
ColorCheck check_colors(const Tracer& tracer, const GroundTruth& truth, const Frame& frame);

/// All about one pixel's colour, for a person.
struct ColorAccount {
    ColorVerdict verdict = ColorVerdict::not_judged;
    Shading truth;
    glm::dvec3 showable{0, 0, 0}; ///< the truth's colour, cut off where the frame buffer does
    glm::dvec3 claim{0, 0, 0};
    Intervals bound;
    Intervals foreseen;
    std::array<double, all_color_terms.size()> weights{}; ///< by ColorTerm, in steps of 1/255
};
ColorAccount account_for_color(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                               int x, int y);

} // namespace shadowproof
