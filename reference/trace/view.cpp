#include "reference/trace/view.h"

#include "reference/exact/norms.h"
#include "reference/parallel.h"
#include "reference/walk/reach.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// The determinant in double is off by at most 48 u m l^2, m the largest coordinate of a - O (or of
/// the direction) and l that of an edge: the normal's components are off by 8 u l^2 (two products
/// of edges rounded to u), which weighs 3 m; the dot product adds 4 u times its 3 terms of m 2 l^2.
std::int8_t side_of(const glm::dvec4& from, const Corners& t, const Predicates& predicates) {
    constexpr double u = double_roundoff;
    const glm::dvec3 a = from.w * t.a - glm::dvec3(from);
    const glm::dvec3 ab = t.b - t.a;
    const glm::dvec3 ac = t.c - t.a;
    const double det = glm::dot(a, glm::cross(ab, ac));
    const double l = std::max(largest(ab), largest(ac));
    const double bound = 50 * u * largest(a) * l * l + std::numeric_limits<double>::min();
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return static_cast<std::int8_t>(predicates.side(from, t).sign);
}

} // namespace

OriginView view_from(const glm::dvec4& from, bool may_be_parallel, const Scene& scene,
                     const BoxTrees& trees, const Places& places, const Predicates& predicates,
                     int threads) {
    OriginView view;
    view.scene = &scene;
    view.trees = &trees;
    view.places = &places;
    const Clusters& clusters = trees.clusters();
    const glm::dvec3 middle = trees.frame().center;
    const double around = reach_of_most(clusters, middle);
    const bool far = may_be_parallel && from.w != 0 && around > 0 &&
                     largest(glm::dvec3(from) - middle) > far_light * around;
    view.parallel = from.w == 0 || far;
    view.origin = view.parallel ? middle : glm::dvec3(from);
    const double reach = reach_of_most(clusters, view.origin);
    const int room = far ? 3 : (view.parallel ? 2 : 1);
    view.scale = reach > 0 ? std::exp2(-std::ilogb(reach) - room) : 1;
    if (view.parallel)
        view.shear = shear_along(
            far ? (glm::dvec3(from) - view.origin) * view.scale : glm::dvec3(from), far);
    view.side.resize(scene.triangles.size());
    parallel_for_all(scene.triangles.size(), threads, [&](std::size_t i) {
        view.side[i] = side_of(from, corners(scene, static_cast<std::uint32_t>(i)), predicates);
    });
    return view;
}

void set_cluster_sides(OriginView& view, const std::vector<std::uint8_t>& double_sided) {
    const Clusters& clusters = view.trees->clusters();
    view.clusters.assign(clusters.all.size(), {});
    for (std::size_t i = 0; i < clusters.all.size(); ++i) {
        ClusterSides& sides = view.clusters[i];
        for (std::size_t k = 0; k < cluster_capacity; ++k) {
            const std::uint32_t triangle = clusters.all[i].triangles[k];
            if (triangle == no_triangle) break;
            const auto set = [&](std::uint8_t& bits, bool holds) {
                bits = static_cast<std::uint8_t>(bits | (holds ? 1U << k : 0U));
            };
            set(sides.front, view.side[triangle] < 0);
            set(sides.back, view.side[triangle] > 0);
            set(sides.double_sided, double_sided[triangle] != 0);
            set(sides.copied, view.places->next[triangle] != no_triangle);
        }
    }
}

} // namespace shadowproof
