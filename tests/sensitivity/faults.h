// The fault that is switched on, in those copies of the sources that patch.mjs has put faults into.
#pragma once

#include <atomic>
#include <span>
#include <string_view>

namespace shadowproof::faults {

inline constexpr int none = -1;

/// Number of the fault in all_faults().
inline std::atomic<int> active = none;

inline bool is(int fault) {
    return active == fault;
}

/// How large the fault is that is switched on, if it may be of any size: AMOUNT in its text.
inline std::atomic<double> amount = 0;

/// Where a fault takes effect.
enum class Scope {
    claim,  ///< while a technique draws
    shared, ///< in code that techniques and judge have in common: while both are at work
};

struct Fault {
    std::string_view name;
    std::string_view kind;       ///< geometry, state, numbers, light, lighting, figures, shared
    std::string_view techniques; ///< those that it is tried with, by commas; empty: all
    std::string_view file;
    std::string_view right; ///< the text that it stands in place of
    std::string_view wrong;
    std::string_view why; ///< why it changes nothing, or is not caught
    Scope scope = Scope::claim;
    std::string_view scenes; ///< those that it is tried on, by commas; empty: all
    int largest = 0;         ///< of a fault of any size: tried from 2 to this power, which is < 0
    int aim = 0;             ///< of such: caught at 2 to this power at the least
    std::string_view unit;   ///< of such: what its size is measured in
    std::string_view own;    ///< of such: by how much the rasterizer itself may be off
};

/// In the order of the catalogue.
std::span<const Fault> all_faults();

/// A shader's text with the fault in it that is switched on. Lives as long as the program.
std::string_view shader(std::string_view text);

} // namespace shadowproof::faults
