// Draco's encoder, in a library of its own: Draco's symbols must not meet tinygltf's.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof::test {

/// Triangles and their vertices, compressed. Attribute 0 holds the positions, of `position_bits` a
/// coordinate, all of them where that is 0. The order of edgebreaker's vertices is another.
__attribute__((visibility("default"))) std::vector<std::uint8_t>
draco_of(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
         bool edgebreaker, int position_bits);

} // namespace shadowproof::test
