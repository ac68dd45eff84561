#include "reference/predict/region_ledger.h"
#include "reference/trace/faces.h"
#include "reference/trace/view.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"
#include "tests/reference/ray_ledger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

constexpr int side = 16; // of a region, in pixels

/// Calls visit(ledger, x0, y0) for every `step`th region of the picture in each direction.
template <class Visit>
void for_regions(const Tracer& tracer, int step, const Visit& visit) {
    const Camera& camera = tracer.scene().camera;
    const Silhouette silhouette(tracer);
    for (int y = 0; y < camera.height; y += side * step)
        for (int x = 0; x < camera.width; x += side * step) {
            const int right = std::min(x + side, camera.width);
            const int bottom = std::min(y + side, camera.height);
            visit(RegionLedger(tracer, silhouette, corner_lines(camera, x, y, right, bottom)), x,
                  y);
        }
}

/// A bundled scene by its name, before an orthographic camera, and with its light gone to infinity:
/// "ordinary_in_parallel_under_a_sun". The direction is that from the middle of the scene to the
/// light, so that shadows fall as they did.
Scene scene_named(std::string name) {
    const auto take = [&](const std::string& end) {
        if (!name.ends_with(end)) return false;
        name.resize(name.size() - end.size());
        return true;
    };
    const bool has_sun = take("_under_a_sun");
    const bool is_parallel = take("_in_parallel");
    Scene scene = load_scene(name, {});
    if (is_parallel) {
        scene.camera.projection = Projection::orthographic;
        scene.camera.half_height = 4;
    }
    if (!has_sun) return scene;
    Light& light = scene.lights[scene.light];
    light.kind = Light::Kind::directional;
    light.direction = glm::normalize(glm::dvec3(scene.positions.front()) - light.position);
    return scene;
}

class RegionLedgerTest : public testing::TestWithParam<std::string> {};

TEST_P(RegionLedgerTest, the_crossings_are_those_found_ray_by_ray) {
    const Scene scene = scene_named(GetParam());
    const Tracer tracer(scene);
    std::vector<Crossing> found;
    for_regions(tracer, 8, [&](RegionLedger region, int x0, int y0) {
        for (int y = y0; y < y0 + side; y += 5)
            for (int x = x0; x < x0 + side; x += 5) {
                const glm::dvec3 direction = line_of_sight(scene.camera, x + 0.5, y + 0.5);
                region.crossings(direction, found);
                const std::vector<Crossing> expected = ray_ledger(tracer, direction).crossings;
                ASSERT_EQ(found.size(), expected.size()) << x << ", " << y;
                for (std::size_t i = 0; i < found.size(); ++i) {
                    EXPECT_EQ(found[i].depth, expected[i].depth) << x << ", " << y;
                    EXPECT_EQ(found[i].change, expected[i].change) << x << ", " << y;
                    EXPECT_EQ(found[i].is_side(), expected[i].is_side()) << x << ", " << y;
                }
            }
    });
}

TEST_P(RegionLedgerTest, the_crossings_add_up_to_the_exact_counts_at_every_pixel) {
    const Scene scene = scene_named(GetParam());
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const ShadowDepths depths = count_shadow_depths(tracer, truth, finite_far(scene));
    std::vector<Crossing> found;
    for_regions(tracer, 1, [&](RegionLedger region, int x0, int y0) {
        for (int y = y0; y < std::min(y0 + side, scene.camera.height); ++y)
            for (int x = x0; x < std::min(x0 + side, scene.camera.width); ++x) {
                region.crossings(line_of_sight(scene.camera, x + 0.5, y + 0.5), found);
                std::int32_t near = depths.at_eye;
                std::int32_t far = depths.at_eye;
                std::int32_t infinity = depths.at_eye;
                for (const Crossing& crossing : found) {
                    if (crossing.depth < scene.camera.near) near += crossing.change;
                    if (crossing.depth < depths.far) far += crossing.change;
                    infinity += crossing.change;
                }
                ASSERT_EQ(near, depths.at_near.at(x, y)) << x << ", " << y;
                ASSERT_EQ(far, depths.at_far.at(x, y)) << x << ", " << y;
                ASSERT_EQ(infinity, depths.at_infinity.at(x, y)) << x << ", " << y;
            }
    });
}

INSTANTIATE_TEST_SUITE_P(Bundled, RegionLedgerTest,
                         testing::Values("ordinary", "near_plane", "far_plane", "eye_inside",
                                         "ordinary_under_a_sun", "near_plane_under_a_sun",
                                         "far_plane_under_a_sun", "eye_inside_under_a_sun",
                                         "ordinary_in_parallel", "near_plane_in_parallel",
                                         "far_plane_in_parallel", "eye_inside_in_parallel",
                                         "ordinary_in_parallel_under_a_sun",
                                         "eye_inside_in_parallel_under_a_sun"),
                         [](const auto& scene) { return scene.param; });

} // namespace
} // namespace shadowproof
