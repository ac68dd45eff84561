#include "compare/blank.h"

#include "scenes/error.h"
#include "scenes/scene.h"

#include <fmt/format.h>

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

void refuse_blank_truth(const std::string& scene, const GroundTruth& truth) {
    if (!has_surfaces(truth))
        throw Error(scene, "nothing is seen: every pixel is background, and agreement says nothing",
                    "turn or move the camera, or name another one with --camera");
}

std::optional<std::string> note_if_one_class_is_seen(const GroundTruth& truth) {
    const bool lit = truth.statistics.lit > 0;
    if (!has_surfaces(truth) || (lit && truth.statistics.shadowed > 0)) return std::nullopt;
    return fmt::format("no pixel is in {}: agreement says little; turn or move the camera or the "
                       "light",
                       lit ? "shadow" : "light");
}

} // namespace shadowproof
