// Closed triangle meshes, counter-clockwise from outside. Each welds to a two-manifold, except
// boxes whose faces are divided differently.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace shadowproof::author {

struct Shape {
    std::vector<glm::dvec3> vertices;
    std::vector<glm::uvec3> triangles;
    // One per vertex where the shape is textured, else none:
    std::vector<glm::dvec3> normals{};     ///< unit
    std::vector<glm::dvec2> coordinates{}; ///< of textures
    std::vector<glm::dvec4> tangents{};    ///< as in glTF; may be none even so
};

/// Axis-aligned, around the origin, each face `segments` by `segments` squares.
Shape box(const glm::dvec3& half_size, unsigned segments);

/// The same with `segments[axis]` on the two faces across that axis: where these are not all equal,
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

/// How a texture is wrapped around a ball: once, or half way round and back, mirrored.
enum class Wearing { around, mirrored };

/// An ellipsoid of half axes `radii`, with `around` meridians and `down` rows from pole to pole.
/// The texture repeats `repeats` times around it and from pole to pole; without tangents.
Shape textured_ball(const glm::dvec3& radii, unsigned around, unsigned down, Wearing wearing,
                    const glm::dvec2& repeats);

/// As torus, with tangents; the texture repeats `repeats` times along the ring and around the tube.
Shape textured_torus(double ring_radius, double tube_radius, unsigned ring, unsigned tube,
                     const glm::dvec2& repeats);

/// As box, the texture once on every face; flat normals, without tangents.
Shape textured_box(const glm::dvec3& half_size, unsigned segments);

/// A ring of a body of revolution around y.
struct Ring {
    double radius = 0;
    double height = 0;
};

/// A lathe through rings from the top to the bottom, the first and the last of radius 0, each with
/// `around` segments and `depth` times as deep (z) as wide. Textured as a ball, along the outline
/// from end to end. Has tangents with Wearing::around; mirrored, the two halves differ in tangents
/// at the vertices that they share.
Shape textured_lathe(const std::vector<Ring>& rings, double depth, unsigned around, Wearing wearing,
                     const glm::dvec2& repeats);

/// Rings of a capsule for textured_lathe: half spheres of `cap_rings` rings each, and a cylinder
/// between.
std::vector<Ring> capsule(double radius, double half_length, unsigned cap_rings);

/// Height and slopes along x and z at (x, z).
using Ground = std::function<glm::dvec3(double x, double z)>;

/// A block whose top, `segments` squares each way, lies `ground` above half_size.y, with smooth
/// normals, without tangents. The texture is projected from above, once over the top, and continues
/// by `border` (a share of its width) past it on all sides.
Shape textured_ground(const glm::dvec3& half_size, unsigned segments, const Ground& ground,
                      double border);

/// The shape mirrored at x = 0, still counter-clockwise from outside; the texture coordinates stay,
/// so the picture is mirrored too.
Shape mirrored(const Shape& shape);

Shape moved(const Shape& shape, const glm::dvec3& way);

/// Several shapes as one; either all of them have textures or none.
Shape joined(const std::vector<Shape>& shapes);

/// The shape with equal points merged to one vertex.
Shape welded(const Shape& shape);

} // namespace shadowproof::author
