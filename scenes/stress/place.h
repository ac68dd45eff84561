// Places and lengths of a scene that stress parameters refer to.
#pragma once

#include "scenes/scene.h"

#include <glm/vec3.hpp>
#include <optional>

namespace shadowproof {

/// The median distance of the vertices from the eye: a few far ones, such as a huge floor's
/// corners, have no influence. World units; positive, 1 where all vertices are at the eye.
double size_of(const Scene& scene);

/// Suits all parameters that need nothing.
inline bool any_scene(const Scene& /*scene*/) {
    return true;
}

/// The mesh that casts and has most triangles; none where nothing casts.
std::optional<std::uint32_t> main_caster(const Scene& scene);
/// Whether there is one, and all that triangles carry lies in their corners' positions.
bool has_caster_without_bumps(const Scene& scene);

/// The diagonal of a mesh's bounding box, world units; positive, 1 where it is a point.
double diagonal_of(const Scene& scene, const Mesh& mesh);

/// The point of a closed triangle that is nearest to another point (Ericson, Real-Time Collision
/// Detection, 5.1.5), rounded.
glm::dvec3 nearest_point(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                         const glm::dvec3& to);

/// Of a mesh, the point of a face, the vertex, or the middle of an edge nearest to a point.
glm::dvec3 nearest_face_point(const Scene& scene, const Mesh& mesh, const glm::dvec3& to);
glm::dvec3 nearest_vertex(const Scene& scene, const Mesh& mesh, const glm::dvec3& to);
glm::dvec3 nearest_edge_middle(const Scene& scene, const Mesh& mesh, const glm::dvec3& to);

/// Unit; `otherwise` where the vector has no length.
glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& otherwise);

/// Of the triangles that show shadows and that eye and light see from one side, the largest.
std::optional<std::uint32_t> main_receiver(const Scene& scene);

} // namespace shadowproof
