// Cube maps: THE definition of which point of which face a vector points to. Used for the
// normalisation cube map and for reflected environments.
#pragma once

#include "scenes/image.h"
#include "scenes/texture.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// The six faces in OpenGL's order, +x -x +y -y +z -z, all square and of one size, the first row at
/// t = 0.
template <class Texel>
using CubeFaces = std::array<Image<Texel>, 6>;

/// Where a face lies: its plane is at `major`, and `s` and `t` run along it (OpenGL 4.5, table
/// 8.19, whose sc and tc are the products with these).
struct FaceAxes {
    glm::dvec3 major;
    glm::dvec3 s;
    glm::dvec3 t;
};

inline constexpr std::array<FaceAxes, 6> face_axes{{
    {{+1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, +1}, {0, -1, 0}},
    {{0, +1, 0}, {+1, 0, 0}, {0, 0, +1}},
    {{0, -1, 0}, {+1, 0, 0}, {0, 0, -1}},
    {{0, 0, +1}, {+1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
}};

/// The face of the largest component. Among components of equal size, x goes before y before z,
/// where OpenGL leaves the choice to the driver.
inline std::size_t face_of(const glm::dvec3& vector) {
    const glm::dvec3 size(std::abs(vector.x), std::abs(vector.y), std::abs(vector.z));
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return static_cast<std::size_t>(2 * axis + (vector[axis] < 0 ? 1 : 0));
}

/// The vector through a point of a face, both coordinates in [-1, 1]; not normalised.
inline glm::dvec3 through(std::size_t face, double s, double t) {
    const FaceAxes& axes = face_axes[face];
    return axes.major + s * axes.s + t * axes.t;
}

/// The texels of the face that a vector points to, interpolated bilinearly. Never across a seam:
/// beyond the outermost texel centres those texels are repeated. The vector must not be zero.
template <class To, class Texel>
To sample(const CubeFaces<Texel>& faces, const glm::dvec3& vector) {
    const std::size_t face = face_of(vector);
    const FaceAxes& axes = face_axes[face];
    const double major = glm::dot(vector, axes.major);
    const auto taps = [&](const glm::dvec3& axis) {
        return taps_at(Wrap::clamp_to_edge, faces[face].width,
                       (glm::dot(vector, axis) / major + 1) / 2);
    };
    return sample<To>(faces[face], taps(axes.s), taps(axes.t));
}

} // namespace shadowproof
