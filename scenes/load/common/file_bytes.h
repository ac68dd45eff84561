// Bytes of files, with their sizes checked before memory is allocated.
#pragma once

#include "scenes/load/common/place.h"
#include "scenes/memory_budget.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace shadowproof {

using FileBytes = std::vector<unsigned char>; // what tinygltf keeps buffers in

/// All bytes of a file, or the first ones (as many as there are). Refused at `place`: not a regular
/// file (which is never opened, as opening a FIFO waits for a writer), unreadable, beyond
/// limits.bytes, or more than the account has left.
FileBytes read_bytes(const std::filesystem::path& file, const Place& place,
                     const MemoryAccount& memory,
                     std::optional<std::uint64_t> first = std::nullopt);

} // namespace shadowproof
