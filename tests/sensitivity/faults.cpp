#include "tests/sensitivity/faults.h"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <string>
#include <tuple>

namespace shadowproof::faults {

namespace {

std::string with_amount(std::string text) {
    constexpr std::string_view word = "AMOUNT";
    const std::string number = fmt::format("{:e}", amount.load());
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word))
        text.replace(at, word.size(), number);
    return text;
}

} // namespace

std::string_view shader(std::string_view text) {
    const int fault = active;
    if (fault == none) return text;
    const Fault& of = all_faults()[static_cast<std::size_t>(fault)];
    if (!of.file.starts_with("raster/glsl/")) return text;
    const std::size_t at = text.find(of.right);
    if (at == std::string_view::npos) return text;
    static std::map<std::tuple<int, double, const char*>, std::string> made;
    static std::mutex guard;
    const std::lock_guard lock(guard);
    std::string& faulty = made[{fault, amount, text.data()}];
    if (faulty.empty())
        faulty = std::string(text.substr(0, at)) + with_amount(std::string(of.wrong)) +
                 std::string(text.substr(at + of.right.size()));
    return faulty;
}

} // namespace shadowproof::faults
