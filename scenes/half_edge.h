// A half-edge mesh (VGP353 week 5) of any polygon soup, built from triangles in any order. Corners
// that weld are one vertex; a triangle with two equal corners has no area and takes no part. What
// no two-manifold has is data, never an error: as many half-edges as possible have a twin, and
// those without are exactly the surplus of topology.h.
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

/// An edge with both its half-edges, or with the one that it has on a boundary. Where more
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
    std::vector<HalfEdge> half_edges; ///< three a triangle that has an area, in the order given
    std::vector<Edge> edges;          ///< by the lower vertex, then the higher
    std::vector<EdgeFault> faults;    ///< in the same order
};

/// `triangles`: indices into scene.triangles; `welded`: from weld_by_position. Half-edges of an
/// edge find their twins in the order of the triangles. Time is linear but for the sorting of the
/// few edges that share a lower vertex; memory grows with the vertices between the lowest and the
/// highest in use.
HalfEdgeMesh connect(const Scene& scene, std::span<const std::uint32_t> welded,
                     std::span<const std::uint32_t> triangles);

/// "(0, 0, 0) to (0, 0, 1)".
std::string place_of(const Scene& scene, const EdgeFault& fault);

/// "mesh 'fan': the edge (0, 0, 0) to (0, 0, 1) belongs to 3 triangles".
std::string words_of(const Scene& scene, const EdgeFault& fault);

/// A closed chain of three or more vertices, each once, in the direction in which the triangles
/// run it: the hole lies to the right.
using Ring = std::vector<std::uint32_t>;

/// The half-edges without a twin as rings, each half-edge in one. A walk goes around the triangles
/// at a vertex to their other boundary; where it comes to a vertex again, the chain since then is
/// split off. Linear time.
std::vector<Ring> boundary_rings(const HalfEdgeMesh& mesh);

/// Triangles (welded position indices) that close the mesh: with them every edge is run as often
/// one way as the other, whatever soup it was. Each ring gets a fan from its first vertex, which
/// may overlap itself or the mesh. Counting crossings does not mind: any two surfaces over one ring
/// differ by a closed one, so that the volume is as well defined as if the fan were beautiful.
std::vector<glm::uvec3> fill_holes(const HalfEdgeMesh& mesh);

} // namespace shadowproof
