// The hierarchy over a scene's triangles, built by Embree and kept as two flat arrays. Embree's
// answers to rays are in float and differ by instruction set; its trees are as good as any, so the
// tree is Embree's and the signs are ours.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof {

/// The unit of work at the leaves: triangles near to each other.
inline constexpr int cluster_capacity = 8;

/// Levels of entries below the root, at most.
inline constexpr int deepest_level = 66;

/// A box and what is in it. Children of an entry lie side by side in Hierarchy::entries.
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

/// Needs at least one triangle, all coordinates finite. threads 0: one per core. Throws Error.
Hierarchy build_hierarchy(const Scene& scene, int threads);

} // namespace shadowproof
