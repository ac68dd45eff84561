#include "compare/blank.h"

#include "scenes/error.h"
#include "scenes/scene.h"

#include <algorithm>
#include <string>

namespace shadowproof {

namespace {

bool has_surfaces(const GroundTruth& truth) {
    return truth.statistics.lit + truth.statistics.shadowed > 0;
}

} // namespace

void refuse_blank(std::string_view technique, const GroundTruth& truth, const Frame& frame,
                  bool some_unexplained) {
    if (!frame.shows_surface()) return;
    const bool blank = std::all_of(frame.triangle.pixels.begin(), frame.triangle.pixels.end(),
                                   [](std::uint32_t id) { return id == no_triangle; });
    if (has_surfaces(truth) && blank && some_unexplained)
        throw Error(std::string(technique), "blank render: no pixel shows a surface",
                    "see what the driver says, or try another with --gl");
}

std::optional<std::string> note_if_nothing_is_seen(const GroundTruth& truth) {
    if (has_surfaces(truth)) return std::nullopt;
    return "nothing is seen: every pixel is background, and agreement says little; turn or move "
           "the "
           "camera";
}

} // namespace shadowproof
