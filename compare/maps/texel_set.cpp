#include "compare/maps/texel_set.h"

#include "reference/parallel.h"

#include <bit>

namespace shadowproof {

namespace {

/// The place in the block of one of its bits.
Texel texel_of_bit(int bit) {
    const int quarter = bit / 16;
    return {0, quarter % 2 * 4 + bit % 4, quarter / 2 * 4 + bit % 16 / 4};
}

} // namespace

TexelSet::TexelSet(const MapModel& model)
    : blocks_in_row_(static_cast<std::size_t>((model.size + block_side - 1) / block_side)),
      blocks_(model.faces() * blocks_in_row_ * blocks_in_row_) {}

std::vector<Texel> TexelSet::list(int threads) {
    std::size_t count = 0;
    earlier_.clear();
    earlier_.reserve(blocks_.size());
    for (const std::uint64_t bits : blocks_) {
        earlier_.push_back(static_cast<std::uint32_t>(count));
        count += static_cast<std::size_t>(std::popcount(bits));
    }
    std::vector<Texel> texels(count);
    parallel_for_all(blocks_.size(), threads, [&](std::size_t i) {
        std::size_t place = earlier_[i];
        const std::size_t row = i / blocks_in_row_;
        for (std::uint64_t left = blocks_[i]; left != 0; left &= left - 1) {
            Texel texel = texel_of_bit(std::countr_zero(left));
            texel.face = static_cast<std::uint32_t>(row / blocks_in_row_);
            texel.x += static_cast<int>(i % blocks_in_row_) * block_side;
            texel.y += static_cast<int>(row % blocks_in_row_) * block_side;
            texels[place++] = texel;
        }
    });
    return texels;
}

std::optional<std::size_t> TexelSet::place(const Texel& texel) const {
    const std::size_t i = block(texel);
    const std::uint64_t own = bit(texel);
    if ((blocks_[i] & own) == 0) return std::nullopt;
    return earlier_[i] + static_cast<std::size_t>(std::popcount(blocks_[i] & (own - 1)));
}

} // namespace shadowproof
