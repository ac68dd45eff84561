// The scene as seen from one point, the common origin of all rays of a query: the eye, or the light
// (shadow rays run from the light to the surface). Relative to its origin, the distance at which a
// ray meets a plane is a single product, so rounding errors stay relative. The rays of a
// directional light have a common direction instead, and the scene is sheared; the same is done
// where a light is so far away that the scene would look tiny from there.
#pragma once

#include "reference/exact/predicates.h"
#include "reference/trace/places.h"
#include "reference/trace/shear.h"
#include "reference/walk/box_trees.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

inline Corners corners(const Scene& scene, std::uint32_t triangle) {
    return {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)};
}

/// One bit for each triangle of a cluster.
struct ClusterSides {
    std::uint8_t front = 0; ///< OriginView::side is -1
    std::uint8_t back = 0;  ///< 1
    std::uint8_t double_sided = 0;
    std::uint8_t copied = 0; ///< others have the same corners (Places)
};

struct OriginView {
    const Scene* scene = nullptr;
    const BoxTrees* trees = nullptr;
    const Places* places = nullptr;
    bool parallel = false;      ///< rays have one direction, not one origin, or nearly (shear.h)
    glm::dvec3 origin{0, 0, 0}; ///< where rays are parallel: the scene's centre
    Shear shear;                ///< where rays are parallel
    /// A power of two: relative coordinates times scale lie within [-1, 1]; within [-1/2, 1/2]
    /// where rays are parallel, so that they stay within [-1, 1] when sheared, and within
    /// [-1/4, 1/4] where they are only nearly so. The exception is a
    /// few triangles very far out, which are not tested in float.
    double scale = 1;
    /// Per triangle the sign of det(a - O, b - O, c - O): -1 where its front faces the origin, 1
    /// where its back does, 0 where the origin lies in its plane (or it has no area). Exact.
    std::vector<std::int8_t> side;
    std::vector<ClusterSides> clusters; ///< the same, by cluster: after set_cluster_sides
};

/// Sets a view's `clusters` from its `side`. `double_sided`: one flag per triangle.
void set_cluster_sides(OriginView& view, const std::vector<std::uint8_t>& double_sided);

/// `from` in homogeneous coordinates: a point, or the direction from which parallel rays come.
/// `may_be_parallel`: whether rays from a point far away may be taken for nearly parallel; only
/// any-hit and counting queries can be.
OriginView view_from(const glm::dvec4& from, bool may_be_parallel, const Scene& scene,
                     const BoxTrees& trees, const Places& places, const Predicates& predicates,
                     int threads);

} // namespace shadowproof
