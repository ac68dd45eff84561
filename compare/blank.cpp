#include "compare/blank.h"

#include "scenes/error.h"
#include "scenes/scene.h"

#include <algorithm>
#include <string>

namespace shadowproof {

void refuse_blank(std::string_view technique, const GroundTruth& truth, const Frame& frame) {
    const bool has_surfaces = truth.statistics.lit + truth.statistics.shadowed > 0;
    const bool blank = std::all_of(frame.triangle.pixels.begin(), frame.triangle.pixels.end(),
                                   [](std::uint32_t id) { return id == no_triangle; });
    if (has_surfaces && blank)
        throw Error(std::string(technique), "blank render: no pixel shows a surface",
                    "see what the driver says, or try another with --gl");
}

} // namespace shadowproof
