#include "reference/trace/places.h"
#include "reference/trace/view.h"
#include "scenes/load/catalog.h"
#include "scenes/stress/parameter.h"
#include "tests/reference/hard_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

namespace shadowproof {
namespace {

using Point = std::array<std::int64_t, 3>;

glm::vec3 position(const Point& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

/// (b - a) x (c - a) . (d - a), in integers.
std::int64_t volume(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto minus = [](const Point& p, const Point& q) {
        return Point{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    };
    const Point u = minus(b, a);
    const Point v = minus(c, a);
    const Point w = minus(d, a);
    return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
           (u[0] * v[1] - u[1] * v[0]) * w[2];
}

TEST(Places, triangles_have_one_plane_only_if_integers_say_so_and_one_place_if_their_corners_do) {
    constexpr std::uint32_t seed = 20260917;
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::int64_t> coordinate(-1, 1);
    std::vector<std::array<Point, 3>> triangles(400);
    Scene scene = empty_scene(16);
    for (auto& triangle : triangles) {
        for (Point& p : triangle) p = {coordinate(random), coordinate(random), coordinate(random)};
        add_triangle(scene, position(triangle[0]), position(triangle[1]), position(triangle[2]));
    }
    const Places places = find_places(scene, {}, 2);
    int in_one_plane = 0;
    int in_one_place = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const auto& t = triangles[i];
            const bool same_place = std::multiset<Point>(t.begin(), t.end()) ==
                                    std::multiset<Point>(triangles[k].begin(), triangles[k].end());
            ASSERT_EQ(places.first[i] == places.first[k], same_place) << i << ", " << k;
            in_one_place += same_place ? 1 : 0;
            const auto& u = triangles[k];
            const bool coplanar = std::ranges::all_of(
                u, [&](const Point& p) { return volume(t[0], t[1], t[2], p) == 0; });
            ASSERT_EQ(are_coplanar(corners(scene, static_cast<std::uint32_t>(i)),
                                   corners(scene, static_cast<std::uint32_t>(k))),
                      coplanar);
            if (places.plane[i] != places.plane[k]) continue;
            ++in_one_plane;
            ASSERT_TRUE(coplanar);
        }
    EXPECT_GT(in_one_plane, 100) << "seed " << seed;
    EXPECT_GT(in_one_place, 0) << "seed " << seed;
}

TEST(Places, each_triangle_is_in_the_list_of_its_place_and_in_no_other) {
    const Scene scene =
        stressed(load_scene("ordinary", {}), {.parameter = "coincident_faces", .value = 3});
    const Places places = find_places(scene, {}, 2);
    std::vector<int> listed(scene.triangles.size(), 0);
    for (const std::uint32_t first : places.firsts()) {
        std::uint32_t before = first;
        for (std::uint32_t i = first; i != no_triangle; i = places.next[i]) {
            EXPECT_EQ(places.first[i], first);
            EXPECT_GE(i, before);
            before = i;
            ++listed[i];
        }
    }
    EXPECT_TRUE(std::ranges::all_of(listed, [](int times) { return times == 1; }));
    EXPECT_LE(places.firsts().size(), scene.triangles.size() / 2);
}

TEST(Places, all_triangles_of_an_axis_parallel_face_have_one_plane_and_one_ulp_parts_them) {
    Scene scene = empty_scene(16);
    add_box(scene, {-0.1F, 0.3F, -7}, {0.7F, 1.1F, -5});
    const float higher = std::nextafter(1.1F, 2.0F);
    add_triangle(scene, {-0.1F, higher, -7}, {0.7F, 1.1F, -7}, {0.7F, 1.1F, -5});
    const Places places = find_places(scene, {}, 1);
    const std::set<std::uint32_t> planes(places.plane.begin(), places.plane.end());
    EXPECT_EQ(planes.size(), 7U);
}

TEST(Places, a_triangle_without_an_area_lies_in_no_other_ones_plane) {
    Scene scene = empty_scene(16);
    add_triangle(scene, {0, 0, -3}, {1, 0, -3}, {0, 1, -3});
    add_triangle(scene, {0, 0, -3}, {1, 1, -3}, {2, 2, -3});
    add_triangle(scene, {0, 0, -3}, {0, 0, -3}, {0, 0, -3});
    const Places places = find_places(scene, {}, 1);
    EXPECT_EQ(std::set<std::uint32_t>(places.plane.begin(), places.plane.end()).size(), 3U);
}

} // namespace
} // namespace shadowproof
