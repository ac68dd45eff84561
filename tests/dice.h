// Random choices of a mutation, all from one seed: the same on every machine, which those of the
// standard's distributions are not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>

namespace shadowproof {

class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}

    /// From 0 to `end` - 1; `end` is at least 1. The small bias does not matter here.
    std::size_t below(std::size_t end) { return random_() % end; }
    bool one_in(std::size_t n) { return below(n) == 0; }
    std::uint64_t bits() { return random_(); }
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
    }

    template <class Range>
    auto& one_of(Range& range) {
        return *std::next(std::begin(range), static_cast<std::ptrdiff_t>(below(std::size(range))));
    }

private:
    std::mt19937_64 random_;
};

} // namespace shadowproof
