// A render that shows nothing proves nothing.
#pragma once

#include "compare/classify.h"
#include "reference/trace.h"
#include "scenes/frame.h"

#include <optional>
#include <string>
#include <string_view>

namespace shadowproof {

/// Throws Error naming the technique where no pixel of its frame shows a surface, the truth has
/// some, and nobody explains all of that. A scene that is all background may be blank, and so may
/// one of slivers between pixels, or one whose depths all round to the background's.
void refuse_blank(std::string_view technique, const GroundTruth& truth, const Frame& frame,
                  const Comparison& comparison);

/// A note for a scene of which the picture shows nothing, so that whatever is claimed agrees;
/// nothing where it shows some.
std::optional<std::string> note_if_nothing_is_seen(const GroundTruth& truth);

} // namespace shadowproof
