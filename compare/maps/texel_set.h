// A set of a map's texels, one bit each, and their places in a list.
#pragma once

#include "compare/maps/light_view.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace shadowproof {

/// First texels are added; once they are listed none may be.
class TexelSet {
public:
    explicit TexelSet(const MapModel& model);

    /// From any number of threads at once.
    void add(const Texel& texel) { add(block(texel), bit(texel)); }
    /// The texels of a row from one to another column, which is included.
    void add_row(Texel first, int last) {
        for (; first.x <= last; first.x = (first.x / 4 + 1) * 4) {
            const int count = std::min(last + 1 - first.x, 4 - first.x % 4);
            add(block(first), ((std::uint64_t{1} << count) - 1) * bit(first));
        }
    }
    /// In blocks of 4x4, so that sixteen rays in a row lie close to each other.
    std::vector<Texel> list(int threads);
    /// Where the list has it.
    std::optional<std::size_t> place(const Texel& texel) const;

private:
    static constexpr int block_side = 8;
    std::size_t blocks_in_row_ = 0;
    std::vector<std::uint64_t> blocks_;  ///< of 8x8 texels, a bit each
    std::vector<std::uint32_t> earlier_; ///< how many texels lie in the blocks before

    void add(std::size_t block, std::uint64_t added) {
        std::atomic_ref bits(blocks_[block]);
        // Neighbouring pixels ask the same texels: most are there, and reading shares the line.
        if ((~bits.load(std::memory_order_relaxed) & added) != 0)
            bits.fetch_or(added, std::memory_order_relaxed);
    }
    std::size_t block(const Texel& texel) const {
        const auto row = static_cast<std::size_t>(texel.y / block_side);
        const auto column = static_cast<std::size_t>(texel.x / block_side);
        return (texel.face * blocks_in_row_ + row) * blocks_in_row_ + column;
    }
    /// Its bit in its block: four blocks of 4x4, each by rows.
    static std::uint64_t bit(const Texel& texel) {
        const auto x = static_cast<unsigned>(texel.x) % block_side;
        const auto y = static_cast<unsigned>(texel.y) % block_side;
        return std::uint64_t{1} << ((y / 4 * 2 + x / 4) * 16 + y % 4 * 4 + x % 4);
    }
};

} // namespace shadowproof
