// Tangents of textured triangles by the rule of MikkTSpace, which glTF requires where an asset has
// none.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace shadowproof {

struct TexturedCorner {
    glm::vec3 position{0, 0, 0};
    glm::vec3 normal{0, 0, 1}; ///< unit
    glm::vec2 at{0, 0};        ///< texture coordinates, glTF's: v grows down the picture
};

/// A tangent for each corner of triangles with three corners each: xyz normalised, at right angles
/// to the normal; w = 1 or -1, so that the bitangent w cross(normal, tangent) runs up the picture.
/// After M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), sections 2.1 and 4, and
/// the conventions of his published code:
///
/// 1. Corners with equal position, normal and texture coordinates are one vertex.
/// 2. With (x, y) = (u, 1 - v), edges e1, e2 of a triangle from its first corner and their texture
///    images (x1, y1), (x2, y2): its area in the texture is A = (x1 y2 - x2 y1) / 2, and it is
///    mirrored where A < 0. Its tangent is dP/dx, along (y2 e1 - y1 e2) / A.
/// 3. Triangles around a vertex that are connected by shared edges, and are all mirrored or all
///    not, have one tangent there: the sum of theirs, each first projected into the vertex's
///    tangent plane, normalised, and weighted by the triangle's angle there, in that plane. So
///    where a mirrored chart meets another, each has its own.
/// 4. w is -1 where the triangles are mirrored.
///
/// A triangle without area, in space or in the texture, counts for nothing: its corners take the
/// tangent of the first triangle at the same vertex, else any at right angles to the normal; and
/// all three of them take the w of its first corner.
std::vector<glm::vec4> make_tangents(const std::vector<TexturedCorner>& corners);

/// Bytes per corner that make_tangents takes, at most, including the corners and the tangents: a
/// corner 32; its vertex number 4, its place in the table of vertices 64 and up to 16; a third of a
/// chart, 11, and twice as much while they grow; its group 4; the edge that waits for its neighbour
/// 64, 32 for its list, up to 16 for its place; the sum 24, the first corner 4, the tangent 16.
inline constexpr std::size_t tangent_bytes = 32 + 4 + 80 + 33 + 4 + 112 + 24 + 4 + 16;

/// A unit vector at right angles to the unit vector `normal`: the axis of its smallest component
/// (the first of equals) less that axis's part along `normal`, normalised.
glm::dvec3 any_tangent(const glm::dvec3& normal);

} // namespace shadowproof
