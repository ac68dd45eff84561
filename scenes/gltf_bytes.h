// Bytes of files and of GLB chunks, with their sizes checked before memory is taken.
#pragma once

#include "scenes/gltf_place.h"
#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace shadowproof::gltf {

using Bytes = std::vector<unsigned char>; // what tinygltf keeps buffers in

/// All bytes of a file, or the first ones (as many as there are). Refused at `place`: not a
/// regular file (which is never opened: opening a FIFO waits for somebody to write), unreadable,
/// beyond limits.bytes, or more than the account has left.
Bytes read_bytes(const std::filesystem::path& file, const Place& place, const MemoryAccount& memory,
                 std::optional<std::uint64_t> first = std::nullopt);

/// The two parts of an asset's file: a .gltf is JSON alone.
struct Chunks {
    std::string_view json;
    std::optional<std::span<const unsigned char>> binary;
};

/// Views of `bytes`. tinygltf's own GLB reader looks at neither the version nor the total length,
/// and reads 8 bytes past a last chunk that is too short, so the chunks are taken apart here.
Chunks split_chunks(const Place& root, std::span<const unsigned char> bytes);

} // namespace shadowproof::gltf
