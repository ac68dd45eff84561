#include "tests/sensitivity/faults.h"

#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace shadowproof::faults {

std::string_view shader(std::string_view text) {
    const int fault = active;
    if (fault == none) return text;
    const Fault& of = all_faults()[static_cast<std::size_t>(fault)];
    if (!of.file.starts_with("raster/glsl/")) return text;
    const std::size_t at = text.find(of.right);
    if (at == std::string_view::npos) return text;
    static std::map<std::pair<int, const char*>, std::string> made;
    static std::mutex guard;
    const std::lock_guard lock(guard);
    std::string& faulty = made[{fault, text.data()}];
    if (faulty.empty())
        faulty = std::string(text.substr(0, at)) + std::string(of.wrong) +
                 std::string(text.substr(at + of.right.size()));
    return faulty;
}

} // namespace shadowproof::faults
