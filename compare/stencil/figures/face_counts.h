// Lower and upper bounds of the number of volume faces that cover each pixel, and of those that are
// not behind what is seen there.
#pragma once

#include "compare/stencil/figures/drawn_picture.h"
#include "compare/stencil/figures/figure_range.h"
#include "scenes/image.h"

#include <cstdint>

namespace shadowproof {

struct FaceCounts {
    FigureRange fragments; ///< of all faces, hidden or not
    /// Faces that are not behind what `frame` shows there. Empty where only fragments were asked
    /// for.
    Image<std::int32_t> low;
    Image<std::int32_t> high;
};

FaceCounts count_faces(const DrawnPicture& picture, int threads);
/// Without low and high; of the frame, only how it is made matters.
FigureRange count_fragments(const DrawnPicture& picture, int threads);

} // namespace shadowproof
