// Why something has no result although it was not refused.
#pragma once

#include <cstdint>
#include <string_view>

namespace shadowproof {

enum class Loss : std::uint8_t {
    none,
    crashed,   ///< the process that tried it was ended by a signal
    timed_out, ///< it took longer than --timeout
};

/// "crashed", "timed_out"; empty for none.
constexpr std::string_view name_of(Loss loss) {
    if (loss == Loss::none) return {};
    return loss == Loss::crashed ? "crashed" : "timed_out";
}

/// The loss of that name; none for another text.
constexpr Loss loss_of(std::string_view name) {
    if (name == name_of(Loss::crashed)) return Loss::crashed;
    return name == name_of(Loss::timed_out) ? Loss::timed_out : Loss::none;
}

} // namespace shadowproof
