// A render that shows nothing proves nothing.
#pragma once

#include "reference/trace.h"
#include "scenes/frame.h"

#include <optional>
#include <string>
#include <string_view>

namespace shadowproof {

/// Throws Error naming the technique where no pixel of its frame shows a surface and the truth has
/// some. A scene that is all background may be blank.
void refuse_blank(std::string_view technique, const GroundTruth& truth, const Frame& frame);

/// A note for a scene of which the picture shows nothing, so that whatever is claimed agrees;
/// nothing where it shows some.
std::optional<std::string> note_if_nothing_is_seen(const GroundTruth& truth);

} // namespace shadowproof
