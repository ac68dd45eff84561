#include "compare/command/process/place_in_run.h"

#include <fmt/format.h>

namespace shadowproof {

std::string place_in_run(std::size_t scene, std::size_t scenes, double seconds) {
    if (scenes == 1) return {};
    std::string words = fmt::format("scene {} of {}", scene + 1, scenes);
    if (scene > 0)
        words += fmt::format(", about {:.0f} s left", seconds / static_cast<double>(scene) *
                                                          static_cast<double>(scenes - scene));
    return words + ": ";
}

} // namespace shadowproof
