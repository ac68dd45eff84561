#include "reference/trace/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace shadowproof {
namespace {

/// A row of 64 triangles of size 1 around the origin, and one with a corner at `far`.
Scene row_with_a_far_corner(float far) {
    Scene scene;
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        scene.positions.insert(scene.positions.end(), {a, b, c});
        scene.triangles.emplace_back(first, first + 1, first + 2);
    };
    for (int i = 0; i < 64; ++i) {
        const auto x = static_cast<float>(i - 32);
        add({x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0.5F});
    }
    add({0, 0, 1}, {1, 0, 1}, {0, far, 1});
    return scene;
}

class FarCorner : public testing::TestWithParam<glm::dvec4> {};

TEST_P(FarCorner, takes_nothing_from_what_floats_see_of_the_others) {
    for (const float far : {1e12F, 1e18F}) {
        const Scene scene = row_with_a_far_corner(far);
        const Places places = find_places(scene, {}, 1);
        const Clusters clusters = build_clusters(scene, places.firsts(), places.plane, 1);
        const BoxTrees trees(clusters, 1);
        const OriginView view = view_from(GetParam(), true, scene, trees, places, {}, 1);
        EXPECT_GE(view.scale * 64, 0.125);
        EXPECT_GE(trees.frame().scale * 64, 0.25);
    }
}

TEST_P(FarCorner, that_is_not_far_is_scaled_like_the_others) {
    const Scene scene = row_with_a_far_corner(1000);
    const Places places = find_places(scene, {}, 1);
    const Clusters clusters = build_clusters(scene, places.firsts(), places.plane, 1);
    const BoxTrees trees(clusters, 1);
    const OriginView view = view_from(GetParam(), true, scene, trees, places, {}, 1);
    EXPECT_LE(view.scale * 1000, 1);
    EXPECT_LE(trees.frame().scale * 500, 1);
}

INSTANTIATE_TEST_SUITE_P(SeenFrom, FarCorner,
                         testing::Values(glm::dvec4(0, 0, 10, 1), glm::dvec4(0.5, 1, 0.25, 0)));

} // namespace
} // namespace shadowproof
