// The boundary of a triangle soup welded by position: the surplus of its edges, and for each caster
// whether it is closed, two-manifold and wound outwards.
#pragma once

#include "scenes/mesh/half_edge.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// For each position the index of the first position that is equal to it (-0 equals 0).
std::vector<std::uint32_t> weld_by_position(std::span<const glm::vec3> positions);

/// Indices into Scene::triangles, in order.
std::vector<std::uint32_t> triangles_of(const Mesh& mesh);

/// A directed edge of the welded soup with its surplus: how many more triangles run it from a to b
/// than from b to a. Where all surpluses are zero, the soup bounds a volume.
struct SurplusEdge {
    std::uint32_t a = 0; ///< welded position indices
    std::uint32_t b = 0;
    int surplus = 0; ///< > 0
};

/// The boundary of a set of triangles (indices into scene.triangles), in a deterministic order (by
/// a, then b). Triangles with two equal welded corners have no area and are ignored. O(n log n)
/// time.
std::vector<SurplusEdge> boundary(const Scene& scene, std::span<const std::uint32_t> welded,
                                  std::span<const std::uint32_t> triangles);

/// Whether the volume that triangles enclose is certainly negative: they are wound inwards.
bool encloses_negative_volume(const Scene& scene, std::span<const std::uint32_t> triangles);

/// What one mesh is as a caster.
struct CasterReport {
    std::uint32_t mesh = 0;
    std::size_t boundary_edges = 0;       ///< edges with a surplus: more triangles on one side
    std::size_t rings = 0;                ///< closed chains of boundary edges, each vertex once
    std::size_t non_manifold_edges = 0;   ///< edges with more than two triangles
    std::size_t inconsistent_edges = 0;   ///< edges whose two triangles run them the same way
    std::optional<EdgeFault> first_fault; ///< of the edges of the last two kinds
    bool closed_by_others = false; ///< open by itself, but not together with all other open meshes
                                   ///< (one body in several materials)
    bool inverted = false;         ///< closed, and its volume negative: wound inside out
    bool closed() const { return boundary_edges == 0; }
    bool encloses_volume() const { return closed() || closed_by_others; }
};

/// Of the meshes that cast, in the order of scene.meshes.
std::vector<CasterReport> inspect_casters(const Scene& scene);

/// One line of text about a caster that is open, inconsistently wound, inverted or not
/// two-manifold; empty where it is none of these.
std::string words_of(const Scene& scene, const CasterReport& report);

} // namespace shadowproof
