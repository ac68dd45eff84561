// Texels that many pixels ask are traced once, which changes nothing of what each is told.
#include "compare/picture/light_sampling.h"
#include "compare/picture/predict.h"
#include "tests/compare/traced_bundled.h"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

/// Every so many that may be lit.
std::vector<glm::dvec3> some_points(const TracedScene& traced) {
    constexpr int every = 61;
    const Camera& camera = traced.scene().camera;
    std::vector<glm::dvec3> points;
    int count = 0;
    for_each_lightable(traced, all_patches(camera.width, camera.height), [&](int x, int y) {
        if (count++ % every == 0) points.push_back(seen_point(traced, x, y));
    });
    return points;
}

/// A coarse map, so that texels are shared: of a cube, or of the plane that such a light has.
LightSampling coarse_map(const Scene& scene, const MapFilter& filter) {
    LightSampling view;
    view.filter = filter;
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::point)
        view.texels = 64;
    else
        view.plane = TexelPlane{usual_axes(light).front(), 0.03, {0.25, 0.5}};
    return view;
}

class SampledLight : public testing::TestWithParam<std::string> {};

TEST_P(SampledLight, is_the_same_for_each_point_alone) {
    const TracedScene& traced = tests::traced_bundled(GetParam()).traced;
    const Scene casters = seen_from_light(traced.scene(), LightSampling::Culled::none);
    const Tracer tracer(casters, 1);
    const std::vector<glm::dvec3> points = some_points(traced);
    ASSERT_GT(points.size(), 100U);
    std::vector<MapFilter> filters{{}};
    filters.insert(filters.end(), usual_filters.begin(), usual_filters.end());
    for (const MapFilter& filter : filters) {
        const LightSampling view = coarse_map(traced.scene(), filter);
        const std::vector<LightSample> together = sample_light(tracer, view, points);
        ASSERT_EQ(together.size(), points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const LightSample alone = sample_light(tracer, view, std::span(&points[i], 1)).front();
            EXPECT_EQ(together[i].seen_depth, alone.seen_depth) << filter.width << " at " << i;
            EXPECT_EQ(together[i].own_depth, alone.own_depth);
            EXPECT_EQ(together[i].slope, alone.slope);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Bundled, SampledLight, testing::Values("ordinary", "sun", "spot"),
                         [](const auto& tested) { return tested.param; });

TEST(SampledLight, a_place_without_parts_of_texels_asks_one) {
    const TracedScene& traced = tests::traced_bundled("sun").traced;
    const Scene casters = seen_from_light(traced.scene(), LightSampling::Culled::none);
    const Tracer tracer(casters, 1);
    LightSampling view = coarse_map(traced.scene(), {3, MapFilter::Over::square});
    view.plane->corner = {1e17, 1e17};
    EXPECT_EQ(sample_light(tracer, view, some_points(traced)).size(), some_points(traced).size());
}

} // namespace
} // namespace shadowproof
