// Closed triangle meshes, counter-clockwise from outside. Each welds to a two-manifold, but for
// boxes whose faces are not split alike.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace shadowproof::author {

struct Shape {
    std::vector<glm::dvec3> vertices;
    std::vector<glm::uvec3> triangles;
    // One a vertex where the shape is textured, else none:
    std::vector<glm::dvec3> normals{};     ///< unit
    std::vector<glm::dvec2> coordinates{}; ///< of textures
    std::vector<glm::dvec4> tangents{};    ///< as glTF has them; or none all the same
};

/// Axis-aligned, around the origin, each face `segments` by `segments` squares.
Shape box(const glm::dvec3& half_size, unsigned segments);

/// The same with `segments[axis]` on the two faces across that axis: where they are not all equal,
/// corners of one face lie within edges of another.
Shape box(const glm::dvec3& half_size, const glm::uvec3& segments);

/// An icosahedron, each triangle split in four `subdivisions` times, on the sphere.
Shape ball(double radius, unsigned subdivisions);

/// Around the y axis. `ring` segments along it, `tube` around it.
Shape torus(double ring_radius, double tube_radius, unsigned ring, unsigned tube);

/// An upright cylinder around the origin.
Shape disc(double radius, double half_height, unsigned sides);

/// Two pyramids, base to base: points at +-half_height above a round girdle.
Shape gem(double radius, double half_height, unsigned sides);

/// How a texture goes round a ball: once, or half round and back, mirrored.
enum class Wearing { around, mirrored };

/// Half axes, meridians, and rows from pole to pole, the texture `repeats` so often across its
/// width and from pole to pole; without tangents.
Shape textured_ball(const glm::dvec3& radii, unsigned around, unsigned down, Wearing wearing,
                    const glm::dvec2& repeats);

/// As torus, with tangents; the texture `repeats` so often along the ring and around the tube.
Shape textured_torus(double ring_radius, double tube_radius, unsigned ring, unsigned tube,
                     const glm::dvec2& repeats);

/// As box, the texture once on every face; flat normals, without tangents.
Shape textured_box(const glm::dvec3& half_size, unsigned segments);

/// The same with equal points made one vertex.
Shape welded(const Shape& shape);

} // namespace shadowproof::author
