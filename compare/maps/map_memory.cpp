#include "compare/maps/map_memory.h"

#include <fmt/format.h>

namespace shadowproof {

// A texel has four bytes in OpenGL and four as it is read back, and a fifth is added.
void require_map(const MemoryBudget& budget, const TechniqueSettings& asked) {
    if (!asked.map.size) return;
    const auto size = static_cast<std::uint64_t>(*asked.map.size);
    require_memory(budget, program_bytes,
                   {6 * size * size * 10, fmt::format("--map-size {}", size),
                    fmt::format("a cube map of {}x{} texels a face", size, size),
                    "try a smaller --map-size"});
}

} // namespace shadowproof
