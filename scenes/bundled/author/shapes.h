// Closed triangle meshes, counter-clockwise from outside, every vertex shared: each welds to a
// two-manifold.
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

/// An icosahedron, each triangle split in four `subdivisions` times, on the sphere.
Shape ball(double radius, unsigned subdivisions);

/// Around the y axis. `ring` segments along it, `tube` around it.
Shape torus(double ring_radius, double tube_radius, unsigned ring, unsigned tube);

/// An upright cylinder around the origin.
Shape disc(double radius, double half_height, unsigned sides);

} // namespace shadowproof::author
