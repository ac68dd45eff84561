// A render that shows nothing proves nothing.
#pragma once

#include "reference/trace.h"
#include "scenes/frame.h"

#include <string_view>

namespace shadowproof {

/// Throws Error naming the technique where no pixel of its frame shows a surface and the truth has
/// some. A scene that is all background may be blank.
void refuse_blank(std::string_view technique, const GroundTruth& truth, const Frame& frame);

} // namespace shadowproof
