// Judges colours. Where truth and technique agree on surface and visibility: how far each is from
// the truth, whether an error budget explains that distance, and whether the technique's own
// arithmetic predicts the colour. Elsewhere: whether it is the colour of what the technique shows.
#pragma once

#include "compare/color/color_verdict.h"
#include "compare/color/mean_check.h"
#include "compare/driver/interval.h"
#include "compare/driver/lighting/color_terms.h"
#include "reference/shade/pixel_means.h"
#include "reference/shade/shading.h"
#include "reference/trace/lights_before.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// Width of the intervals within which colours count as right: that of the widest channel, in steps
/// of 1/255.
struct BoundWidth {
    double median = 0;
    double percentile999 = 0; ///< 99.9 % of the judged pixels have no wider ones
    double widest = 0;
};

/// A light that the colours add to the chosen one's.
struct LightAdded {
    std::string name;
    std::uint64_t differing = 0; ///< pixels at which its claim is not its truth
};

struct ColorCheck {
    ColorModel model;            ///< how the technique computes them
    Image<float> error;          ///< largest of the channels' differences, in steps of 1/255
    Image<ColorVerdict> verdict; ///< of every pixel
    std::uint64_t judged = 0;    ///< pixels of any verdict but as_shown
    // Differences are in steps of 1/255.
    double largest = 0;             ///< a channel's largest difference
    int largest_x = 0;              ///< its pixel: column; the first in rows from the top
    int largest_y = 0;              ///< and row
    double rmse = 0;                ///< over the channels of all judged pixels
    double picture_rmse = 0;        ///< over those of all pixels: what wrong visibility costs, too
    double percentile999 = 0;       ///< 99.9 % of the judged pixels' errors are no larger
    std::uint64_t beyond = 0;       ///< pixels of that verdict
    std::uint64_t unpredicted = 0;  ///< pixels of that verdict, and those that are unexplained
    std::uint64_t moved = 0;        ///< pixels of that verdict
    std::uint64_t interpolated = 0; ///< pixels within the bound only by snapping and rounding
    BoundWidth bound_width;
    /// Pixels beyond the bound, by the ColorTerm that moves each most (the index).
    std::array<std::uint64_t, all_color_terms.size()> beyond_by{};
    int first_unpredicted_x = 0;
    int first_unpredicted_y = 0;
    std::vector<LightAdded> lights_before{}; ///< in their order
    std::optional<MeanCheck> means{};        ///< where these are known
};

/// The frame must have colours, and the scene must be bump-lit. `before`: the lights that the frame
/// has before the chosen one, here and below. `means`: the right colours of a frame whose model
/// filters; null where none does.
ColorCheck check_colors(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                        const TracedLights& before = {}, const PixelMeans* means = nullptr);

/// What a light that is added shows at a pixel.
struct AddedAtPixel {
    std::string name;
    Visibility truth = Visibility::background;
    Visibility claim = Visibility::background;
};

/// One pixel's colour in full, for `explain`.
struct ColorAccount {
    ColorVerdict verdict = ColorVerdict::as_shown;
    Shading truth;                ///< under the chosen light; before_color is what the others add
    glm::dvec3 showable{0, 0, 0}; ///< the right colour, clamped as by the frame buffer
    glm::ivec2 rays{0, 0}; ///< columns and rows of which that is a mean; 0: it is the centre's
    glm::dvec3 claim{0, 0, 0};
    Intervals bound;
    Intervals predicted;
    ColorTerms weights{}; ///< in steps of 1/255
    std::vector<AddedAtPixel> lights_before{};
};
ColorAccount account_for_color(const Tracer& tracer, const GroundTruth& truth, const Frame& frame,
                               int x, int y, const TracedLights& before = {});

} // namespace shadowproof
