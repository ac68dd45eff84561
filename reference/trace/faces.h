// The planes of the faces that bound shadow volumes, and where an eye ray meets them. The formulas
// are plain products and sums in a fixed order, so that another program can repeat them bit for
// bit.
#pragma once

#include "reference/exact/norms.h"
#include "reference/exact/predicates.h"
#include "scenes/scene.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace shadowproof {

/// Order of points: by x, then y, then z.
inline bool before(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.z < b.z);
}

/// Normal of the plane through the light L = (l, w) and the edge from a to b, not normalised. Both
/// triangles at an edge must get the same bits, so the edge is always taken in one direction.
inline glm::dvec3 side_plane(const glm::dvec4& light, const glm::dvec3& a, const glm::dvec3& b) {
    if (before(b, a)) return -side_plane(light, b, a);
    return glm::cross(light.w * a - glm::dvec3(light), b - a);
}

/// A point of that plane: the light, or the edge's first end where the light is a direction.
inline glm::dvec3 side_point(const glm::dvec4& light, const glm::dvec3& a, const glm::dvec3& b) {
    return light.w != 0 ? glm::dvec3(light) : (before(b, a) ? b : a);
}

/// The same triangle, starting at an end of its shortest edge where that is shorter than 2^-20 of
/// the longest: seen from a corner far away, the two others are nearly one point, and a normal made
/// of the edges to them, or a difference from there, would lose the rest of the scene in rounding.
inline Corners from_short_edge(const Corners& t) {
    const double ab = largest(t.b - t.a);
    const double bc = largest(t.c - t.b);
    const double ca = largest(t.a - t.c);
    const double shortest = std::min({ab, bc, ca});
    if (shortest >= 0x1p-20 * std::max({ab, bc, ca}) || shortest == ab) return t;
    return shortest == bc ? Corners{t.b, t.c, t.a} : Corners{t.c, t.a, t.b};
}

/// Normal of a triangle; it points into the volume behind the triangle where that faces the light.
inline glm::dvec3 cap_plane(const Corners& t) {
    return glm::cross(t.c - t.a, t.b - t.a);
}

/// Parameter t at which start + t D meets a plane through `through`. Infinite or NaN where they are
/// parallel.
inline double depth_on_plane(const glm::dvec3& start, const glm::dvec3& direction,
                             const glm::dvec3& through, const glm::dvec3& plane) {
    return -glm::dot(start - through, plane) / glm::dot(direction, plane);
}

/// The same for the plane of a triangle of the scene and a line of sight: the depth at which that
/// hits the triangle.
inline double depth_on_triangle(const Scene& scene, std::uint32_t triangle,
                                const glm::dvec3& line) {
    const Corners t = from_short_edge(
        {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)});
    return depth_on_plane(start_of(scene.camera, line), direction_of(scene.camera, line), t.a,
                          cap_plane(t));
}

} // namespace shadowproof
