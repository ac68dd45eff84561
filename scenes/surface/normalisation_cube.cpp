#include "scenes/surface/normalisation_cube.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// Bytes of 0.5 + 0.5 n.
glm::u8vec3 compressed(const glm::dvec3& n) {
    glm::u8vec3 bytes(0);
    for (int c = 0; c < 3; ++c)
        bytes[c] = static_cast<std::uint8_t>(std::lround(255 * (0.5 + 0.5 * n[c])));
    return bytes;
}

} // namespace

NormalisationCube make_normalisation_cube(int size) {
    assert(size > 0);
    NormalisationCube cube{size, {}};
    for (std::size_t face = 0; face < cube.faces.size(); ++face) {
        Image<glm::u8vec3>& texels = cube.faces[face];
        texels = Image<glm::u8vec3>(size, size);
        const auto along = [&](int texel) { return (2 * texel + 1.0) / size - 1; };
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                texels.at(x, y) = compressed(glm::normalize(through(face, along(x), along(y))));
    }
    return cube;
}

glm::dvec3 looked_up(const NormalisationCube& cube, const glm::dvec3& vector) {
    if (vector == glm::dvec3(0)) return glm::dvec3(0);
    const auto bytes = sample<glm::dvec3>(cube.faces, vector);
    return 2.0 / 255 * bytes - 1.0;
}

} // namespace shadowproof
