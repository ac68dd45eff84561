// Quake II models made in the test itself.
#pragma once

#include "tests/scenes/small_gltf.h"

#include <array>
#include <string>
#include <vector>

namespace shadowproof::test {

struct Md2Frame {
    std::string name;
    glm::vec3 scale{1, 1, 1};
    glm::vec3 translation{0, 0, 0};
    std::vector<std::array<std::uint8_t, 3>> vertices;
};

/// Indices as the file has them: triangles clockwise from the front.
struct Md2 {
    std::string skin = "models/imp/skin.pcx"; ///< empty: none
    glm::ivec2 size{64, 32};
    std::vector<std::array<std::int16_t, 2>> places;
    std::vector<std::array<std::uint16_t, 6>> triangles; ///< three vertices, three places
    std::vector<Md2Frame> frames;
};

/// The file, its tables in the order in which the game's tools write them.
FileBytes bytes_of(const Md2& model);

/// A tetrahedron with corners at 0 and at 10 along x, y and z, in two frames, "run1" and "run2": in
/// the second the corner along z is at 20, that along x at 30.
Md2 tetrahedron();

} // namespace shadowproof::test
