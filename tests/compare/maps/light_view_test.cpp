// The rays of counterfactuals: the same together and one by one, and what stands before a point.
#include "compare/maps/map_cause.h"
#include "reference/trace/places.h"
#include "reference/trace/view.h"
#include "tests/compare/maps/drawn_map.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace shadowproof {
namespace {

using tests::drawn;
using tests::small;
using tests::TracedScene;

/// The scene's visible points, relative to the light, as they are looked up.
std::vector<PointOnFace> seen_points(const TracedScene& traced, const LightView& light) {
    const Camera& camera = traced.scene.camera;
    std::vector<PointOnFace> points;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            if (traced.truth.triangle.at(x, y) == no_triangle) continue;
            const glm::dvec3 ray = line_of_sight(camera, x + 0.5, y + 0.5);
            const glm::dvec3 from_light =
                camera.eye + traced.truth.depth.at(x, y) * ray - light.origin();
            points.push_back({lookup(light, from_light).texel.face, from_light});
        }
    return points;
}

TEST(LightViews, meet_the_same_with_rays_together_and_one_by_one_whatever_is_lifted) {
    Gpu gpu{GlPlatform::osmesa};
    for (const auto& [name, technique] :
         {std::pair("near_light", "cube_map_six_pass"), std::pair("sun", "sun_map")}) {
        const TracedScene traced(small(name, 32));
        for (const MapCulling culling : all_map_cullings) {
            const Frame frame = drawn(gpu, traced, technique, {.size = 16, .culling = culling});
            const std::unique_ptr<LightView> light = light_view(traced.scene, *frame.mapped, 8, 0);
            const std::vector<PointOnFace> points = seen_points(traced, *light);
            std::size_t range_matters = 0;
            for (const bool range : {false, true})
                for (const bool unculled : {false, true}) {
                    const LiftedLimits lifted{.range = range, .culling = unculled};
                    const std::vector<FromLight> together = light->trace_to(points, lifted);
                    const std::vector<FromLight> limited =
                        light->trace_to(points, {.culling = unculled});
                    for (std::size_t i = 0; i < points.size(); ++i) {
                        const FromLight alone =
                            light->trace_to(std::span(points).subspan(i, 1), lifted).front();
                        ASSERT_EQ(together[i].triangle, alone.triangle)
                            << name << " " << name_of(culling) << " " << i;
                        ASSERT_EQ(together[i].depth, alone.depth) << i;
                        range_matters += together[i].triangle != limited[i].triangle ? 1 : 0;
                    }
                }
            if (std::string(name) == "near_light") {
                EXPECT_GT(range_matters, 50U);
            }
        }
    }
}

/// A floor of two triangles: a point of one's plane beside it lies in the other, at a depth that
/// rounds to either side of the point's own.
TEST(LightViews, let_nothing_in_a_points_own_plane_stand_before_it) {
    Gpu gpu{GlPlatform::osmesa};
    const TracedScene traced(small("thin_caster", 24));
    const Frame frame = drawn(gpu, traced, "cube_map_six_pass", {.size = 16});
    const std::unique_ptr<LightView> light = light_view(traced.scene, *frame.mapped, 8, 0);
    std::size_t nearer = 0;
    for (const PointOnFace& point : seen_points(traced, *light)) {
        const FromLight met = light->trace_to(std::span(&point, 1)).front();
        if (met.triangle == no_triangle) continue;
        const Lookup asked = lookup(*light, point.from_light);
        nearer += met.depth < asked.depth ? 1 : 0;
        for (std::uint32_t other = 0; other < traced.scene.triangles.size(); ++other) {
            const bool before =
                !light_reaches(*light, traced.scene, asked, point.from_light, other);
            const bool in_plane =
                are_coplanar(corners(traced.scene, other), corners(traced.scene, met.triangle));
            ASSERT_EQ(before, met.depth < asked.depth && !in_plane) << other;
        }
    }
    EXPECT_GT(nearer, 100U);
}

} // namespace
} // namespace shadowproof
