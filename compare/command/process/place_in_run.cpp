#include "compare/command/process/place_in_run.h"

#include <fmt/format.h>

namespace shadowproof {

std::string time_left(std::size_t done, std::size_t all, double seconds) {
    if (done == 0) return {};
    return fmt::format(", about {:.0f} s left",
                       seconds / static_cast<double>(done) * static_cast<double>(all - done));
}

std::string place_in_run(std::size_t scene, std::size_t scenes, double seconds) {
    if (scenes == 1) return {};
    return fmt::format("scene {} of {}{}: ", scene + 1, scenes, time_left(scene, scenes, seconds));
}

} // namespace shadowproof
