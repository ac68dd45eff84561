// Mutations of a PNG that get past its checksums: of chunks and their contents, of the pixels
// behind the compression.
#pragma once

#include "tests/dice.h"
#include "tests/fuzz/asset.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof::fuzz {

struct PngChunk {
    std::array<std::uint8_t, 4> type{};
    FileBytes content;
};

/// None where the bytes do not begin as a PNG does. What is behind a chunk that is cut off is lost.
std::optional<std::vector<PngChunk>> read_png(std::span<const std::uint8_t> bytes);

/// With lengths and checksums that are right.
FileBytes written(const std::vector<PngChunk>& chunks);

/// One change.
void mutate_png(std::vector<PngChunk>& chunks, Dice& dice);

} // namespace shadowproof::fuzz
