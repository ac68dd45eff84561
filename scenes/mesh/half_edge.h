// A half-edge mesh (VGP353 week 5) of any polygon soup, built from triangles in any order. Corners
// at equal positions are one vertex; a triangle with two equal corners has no area and is ignored.
// Input that is not two-manifold is data, never an error: as many half-edges as possible have a
// twin, and those without one are exactly the surplus of topology.h.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

inline constexpr std::uint32_t no_half_edge = 0xffffffffU;

/// One side of a triangle, run counter-clockwise. It ends where `next` begins.
struct HalfEdge {
    std::uint32_t origin = 0;          ///< welded position index
    std::uint32_t next = 0;            ///< the half-edge after it around the triangle
    std::uint32_t twin = no_half_edge; ///< the same edge run the other way; none on a boundary
    std::uint32_t triangle = 0;        ///< index into Scene::triangles
};

/// An edge with both its half-edges, or with its only one on a boundary. Where more than two
/// triangles share an edge, each pair is an edge of its own.
struct Edge {
    std::uint32_t half_edge = 0;
    std::uint32_t twin = no_half_edge;
};

/// An edge of more than two triangles, or of two that run it the same way, so that their windings
/// contradict each other.
struct EdgeFault {
    std::uint32_t a = 0; ///< welded position indices, a < b
    std::uint32_t b = 0;
    std::uint32_t from_a_to_b = 0; ///< triangles that run it so
    std::uint32_t from_b_to_a = 0;
    std::uint32_t triangle = 0; ///< one of them
    bool non_manifold() const { return from_a_to_b + from_b_to_a > 2; }
};

struct HalfEdgeMesh {
    std::vector<HalfEdge> half_edges; ///< three per triangle that has an area, in the order given
    std::vector<Edge> edges;          ///< by the lower vertex, then the higher
    std::vector<EdgeFault> faults;    ///< in the same order
};

/// `triangles`: indices into scene.triangles; `welded`: from weld_by_position. Half-edges of an
/// edge are paired in the order of the triangles. Takes linear time, except for sorting the few
/// edges that share a lower vertex; memory grows with the range of vertex indices in use.
HalfEdgeMesh connect(const Scene& scene, std::span<const std::uint32_t> welded,
                     std::span<const std::uint32_t> triangles);

/// Of all triangles of the scene.
HalfEdgeMesh connect_all(const Scene& scene);

/// "(0, 0, 0) to (0, 0, 1)".
std::string place_of(const Scene& scene, const EdgeFault& fault);

/// "mesh 'fan': the edge (0, 0, 0) to (0, 0, 1) belongs to 3 triangles".
std::string words_of(const Scene& scene, const EdgeFault& fault);

/// A closed chain of three or more vertices, each once, in the direction in which the triangles
/// run it: the hole lies to the right.
using Ring = std::vector<std::uint32_t>;

/// The half-edges without a twin as rings, each half-edge in one. From each, a walk goes around the
/// triangles at a vertex to their other boundary; where it returns to a vertex, the chain since
/// then is split off. Linear time.
std::vector<Ring> boundary_rings(const HalfEdgeMesh& mesh);

/// Triangles (welded position indices) that close the mesh: with them every edge is run as often
/// one way as the other, for any soup. Each ring gets a fan from its first vertex, which may
/// overlap itself or the mesh. The count of crossings does not depend on the fan's shape: any two
/// surfaces over one ring differ by a closed one, so the volume is well defined.
std::vector<glm::uvec3> fill_holes(const HalfEdgeMesh& mesh);

} // namespace shadowproof
