// The hierarchy over a scene's triangles, built by Embree and stored as two flat arrays. Only
// Embree's tree is used: its ray queries are in float and differ by instruction set, so all signs
// are computed by reference/ itself.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// Triangles in a leaf's cluster, at most: the unit of work at the leaves.
inline constexpr int cluster_capacity = 8;

/// The number of levels of entries below the root, at most.
inline constexpr int deepest_level = 66;

/// A box and its contents. Children of an entry are adjacent in Hierarchy::entries.
struct Entry {
    std::array<float, 3> lower{};
    std::array<float, 3> upper{};
    std::uint32_t first = 0; ///< first child entry, or the cluster's index
    std::uint32_t count = 0; ///< number of children; 0: a cluster
};

struct Cluster {
    std::array<std::uint32_t, cluster_capacity> triangles{};
    std::uint32_t count = 0;
};

/// entries[0] is the root. Boxes are world-space float32, exactly the bounds of their vertices.
struct Hierarchy {
    std::vector<Entry> entries;
    std::vector<Cluster> clusters;
};

/// Over some triangles of the scene: at least one, all coordinates finite. threads 0: one per core.
/// Throws Error.
Hierarchy build_hierarchy(const Scene& scene, std::span<const std::uint32_t> triangles,
                          int threads);

} // namespace shadowproof
