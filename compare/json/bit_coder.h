// Codes bits, each by how likely it was where it was met before, so that what is expected costs
// next to nothing: a carryless binary range coder (Mahoney, "Adaptive weighing of context models
// for lossless data compression", 2005, section 2). compare/viewer/coded.js reads what it writes,
// and has the same arithmetic, in integers.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// How likely a bit is 1, learned from those that were coded with it.
struct BitChance {
    static constexpr std::int32_t one = 1 << 22;
    static constexpr std::int32_t most_met = 60; ///< from then on the oldest bits are forgotten

    std::int32_t of_one = one / 2; ///< of `one`, and never 0 nor all of it
    std::int32_t met = 0;          ///< bits

    void learn(bool bit) {
        // Towards the bit by 1 / (met + 1.5), as an average of all bits would move.
        of_one += 2 * ((bit ? one - 1 : 1) - of_one) / (2 * met + 3);
        if (met < most_met) ++met;
    }
};

class BitCoder {
public:
    void code(bool bit, BitChance& chance) {
        const std::uint32_t share = static_cast<std::uint32_t>(chance.of_one) >> 6U; // of 2^16
        const std::uint32_t range = high_ - low_;
        const std::uint32_t middle =
            low_ + (range >> 16U) * share + ((range & 0xffffU) * share >> 16U);
        (bit ? high_ : low_) = bit ? middle : middle + 1;
        chance.learn(bit);
        while (((low_ ^ high_) & 0xff000000U) == 0) {
            bytes_ += static_cast<char>(high_ >> 24U);
            low_ <<= 8U;
            high_ = high_ << 8U | 0xffU;
        }
    }

    /// All bytes. What is read behind them is 0.
    std::string finish() {
        // The shortest number from low_ to high_: its first byte, unless low_ is not 0 behind it.
        if (low_ > 0) bytes_ += static_cast<char>((low_ >> 24U) + 1U);
        return std::move(bytes_);
    }

private:
    std::uint32_t low_ = 0;
    std::uint32_t high_ = 0xffffffffU;
    std::string bytes_;
};

/// Codes whole numbers, small ones in few bits: how many bits a number has, then those behind its
/// first; the two highest of these by what was met before, too.
class NumberCoder {
public:
    void code(BitCoder& coder, std::uint32_t value) {
        const auto width = static_cast<std::uint32_t>(std::bit_width(value));
        for (std::uint32_t i = 0; i < width; ++i) coder.code(true, widths_[i]);
        if (width < 32) coder.code(false, widths_[width]);
        std::uint32_t above = 1; // the bits before this one, three at most
        for (std::uint32_t i = 1; i < width; ++i) {
            const bool bit = (value >> (width - 1 - i) & 1U) != 0;
            coder.code(bit, i < 3 ? first_[4 * width + above] : others_[width - i]);
            above = above << 1U | (bit ? 1U : 0U);
        }
    }

private:
    std::vector<BitChance> widths_ = std::vector<BitChance>(33);
    std::vector<BitChance> first_ = std::vector<BitChance>(4 * 33);
    std::vector<BitChance> others_ = std::vector<BitChance>(33);
};

/// Small for numbers near 0, of either sign: 0, -1, 1, -2, ...
constexpr std::uint32_t folded(std::int32_t value) {
    return static_cast<std::uint32_t>(value) << 1U ^ static_cast<std::uint32_t>(value >> 31);
}

} // namespace shadowproof
