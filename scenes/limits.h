// Limits on the size of what is read from files.
#pragma once

#include <cstdint>

namespace shadowproof {

/// Limits of one asset, independent of the budget in bytes (memory_budget.h). They bound the time
/// that reading takes, and keep every count and offset far from overflow.
struct Limits {
    std::uint64_t bytes = 1ULL << 30;       ///< of the file, and of all its buffers together
    std::uint64_t json_bytes = 1ULL << 28;  ///< 256 MiB
    std::uint64_t json_values = 1ULL << 22; ///< 4 million
    std::uint64_t json_depth = 64;          ///< nested objects and arrays
    std::uint64_t elements = 1ULL << 26;    ///< accessor elements read, all reads together
    std::uint64_t triangles = 1ULL << 24;   ///< baked, all nodes together; vertices as many
    std::uint64_t surfaces = 1ULL << 21;    ///< triangles baked for lighting
    std::uint64_t texels = 1ULL << 26;      ///< of all textures together
};
inline constexpr Limits limits;

} // namespace shadowproof
