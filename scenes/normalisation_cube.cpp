#include "scenes/normalisation_cube.h"

#include "scenes/texture.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// Where a face lies: its plane is at `major`, and `s` and `t` run along it (OpenGL 4.5, table
/// 8.19, whose sc and tc are the products with these).
struct FaceAxes {
    glm::dvec3 major;
    glm::dvec3 s;
    glm::dvec3 t;
};

constexpr std::array<FaceAxes, 6> face_axes{{
    {{+1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, +1}, {0, -1, 0}},
    {{0, +1, 0}, {+1, 0, 0}, {0, 0, +1}},
    {{0, -1, 0}, {+1, 0, 0}, {0, 0, -1}},
    {{0, 0, +1}, {+1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
}};

/// Bytes of 0.5 + 0.5 n.
glm::u8vec3 compressed(const glm::dvec3& n) {
    glm::u8vec3 bytes(0);
    for (int c = 0; c < 3; ++c)
        bytes[c] = static_cast<std::uint8_t>(std::lround(255 * (0.5 + 0.5 * n[c])));
    return bytes;
}

std::size_t face_of(const glm::dvec3& vector) {
    const glm::dvec3 size(std::abs(vector.x), std::abs(vector.y), std::abs(vector.z));
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return static_cast<std::size_t>(2 * axis + (vector[axis] < 0 ? 1 : 0));
}

} // namespace

NormalisationCube make_normalisation_cube(int size) {
    assert(size > 0);
    NormalisationCube cube{size, {}};
    for (std::size_t face = 0; face < cube.faces.size(); ++face) {
        const FaceAxes& axes = face_axes[face];
        Image<glm::u8vec3>& texels = cube.faces[face];
        texels = Image<glm::u8vec3>(size, size);
        const auto along = [&](int texel) { return (2 * texel + 1.0) / size - 1; };
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                texels.at(x, y) =
                    compressed(glm::normalize(axes.major + along(x) * axes.s + along(y) * axes.t));
    }
    return cube;
}

glm::dvec3 looked_up(const NormalisationCube& cube, const glm::dvec3& vector) {
    if (vector == glm::dvec3(0)) return glm::dvec3(0);
    const std::size_t face = face_of(vector);
    const FaceAxes& axes = face_axes[face];
    const double major = glm::dot(vector, axes.major);
    const auto taps = [&](const glm::dvec3& axis) {
        return taps_at(Wrap::clamp_to_edge, cube.size, (glm::dot(vector, axis) / major + 1) / 2);
    };
    const auto bytes = sample<glm::dvec3>(cube.faces[face], taps(axes.s), taps(axes.t));
    return 2.0 / 255 * bytes - 1.0;
}

} // namespace shadowproof
