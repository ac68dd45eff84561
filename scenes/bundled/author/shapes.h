// Closed triangle meshes, counter-clockwise from outside. Each welds to a two-manifold, but for
// boxes whose faces are not split alike.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof::author {

struct Shape {
    std::vector<glm::dvec3> vertices;
    std::vector<glm::uvec3> triangles;
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

/// The same with equal points made one vertex.
Shape welded(const Shape& shape);

} // namespace shadowproof::author
