// Refuses blank renders: a picture that shows nothing must not pass as agreement.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <optional>
#include <string>
#include <string_view>

namespace shadowproof {

/// Throws Error naming the technique if no pixel of its frame shows a surface, the truth has
/// surfaces, and a judged pixel is unexplained. A blank frame is right if the scene is all
/// background, has only slivers between pixel centres, or has depths that all round to the
/// background's.
void refuse_blank(std::string_view technique, const GroundTruth& truth, const Frame& frame,
                  bool some_unexplained);

/// Throws Error naming the scene if its picture shows no surface: every claim would agree with it,
/// which would mean nothing.
void refuse_blank_truth(const std::string& scene, const GroundTruth& truth);

/// A note for a picture without any shadow, or without any light; none if both are seen.
std::optional<std::string> note_if_one_class_is_seen(const GroundTruth& truth);

} // namespace shadowproof
