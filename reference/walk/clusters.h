// The scene's triangles in small groups that lie close together, found by Embree's builder: the
// boxes of Embree's walk (box_tree.h), and the units of work of the exact tests.
#pragma once

#include "scenes/scene.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace shadowproof {

/// Triangles in a cluster, at most.
inline constexpr int cluster_capacity = 8;

template <class T>
using PerTriangle = std::array<T, cluster_capacity>;

/// World-space corners lie beside the triangles' numbers, ready for vector instructions: a walk
/// meets clusters in no order that a cache of the scene's vertices could follow.
struct Cluster {
    /// By corner, then axis; 0 where there is no triangle.
    alignas(64) std::array<std::array<PerTriangle<float>, 3>, 3> corner{};
    PerTriangle<std::uint32_t> triangles{}; ///< ascending, then no_triangle
    PerTriangle<std::uint32_t> planes{};    ///< of each the number of its plane
};

/// The bounds of a cluster's corners, in world space: exactly.
struct Box {
    glm::vec3 lower{0};
    glm::vec3 upper{0};
};

struct Clusters {
    std::vector<Cluster> all;
    std::vector<Box> boxes; ///< one per cluster
    Box box;                ///< around all
    /// Boxes around group_size neighbours each: of clusters, then of those groups, and so on up to
    /// less than group_size. For regions that are no rays.
    std::vector<std::vector<Box>> groups;
    static constexpr std::size_t group_size = 8;

    /// Calls work(cluster) for each cluster of which may_meet(box) is true, as it must be of all
    /// boxes around a box of which it is.
    template <class MayMeet, class Work>
    void for_each_in(const MayMeet& may_meet, const Work& work) const {
        if (groups.empty())
            descend(0, 0, boxes.size(), may_meet, work);
        else
            descend(groups.size(), 0, groups.back().size(), may_meet, work);
    }

private:
    template <class MayMeet, class Work>
    void descend(std::size_t level, std::size_t first, std::size_t end, const MayMeet& may_meet,
                 const Work& work) const {
        const std::vector<Box>& here = level == 0 ? boxes : groups[level - 1];
        for (std::size_t i = first; i < std::min(end, here.size()); ++i) {
            if (!may_meet(here[i])) continue;
            if (level == 0)
                work(all[i]);
            else
                descend(level - 1, i * group_size, (i + 1) * group_size, may_meet, work);
        }
    }
};

/// Over some triangles of the scene: at least one, all coordinates finite. `planes`: a number for
/// each triangle of the scene. The same for any number of threads (0: one per core). Throws Error.
Clusters build_clusters(const Scene& scene, std::span<const std::uint32_t> triangles,
                        std::span<const std::uint32_t> planes, int threads);

} // namespace shadowproof
