// Maps of directional lights, drawn in parallel: fitted to the scene, predicted at every texel, and
// wrong for the causes that the settings tell.
#include "compare/evidence.h"
#include "compare/maps/lookup.h"
#include "tests/compare/maps/drawn_map.h"
#include "tests/scenes/over_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

using tests::all_texels;
using tests::compared;
using tests::drawn;
using tests::load_named;
using tests::pixels_of;
using tests::small;
using tests::texels_not_shown;
using tests::TracedScene;

class SunMap : public testing::Test {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene sun{small("sun")};

    Comparison judged(const MapSettings& settings) {
        return compared(sun, drawn(gpu, sun, "sun_map", settings));
    }
};

TEST_F(SunMap, holds_all_that_casts_or_receives_and_little_more) {
    for (const char* name : {"sun", "grazing_light"}) {
        const Scene scene = load_named(name);
        const MapModel model = with_settings(sun_model(), {}, scene);
        const Camera camera = map_camera(chosen_light(scene), model, 0);
        glm::dvec2 low(model.size);
        glm::dvec2 high(0);
        for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 from_eye = corner(scene, triangle, k) - camera.eye;
                const double window = map_window_depth(model, glm::dot(from_eye, camera.forward));
                EXPECT_TRUE(window > 0.001 && window < 0.999) << name << " " << window;
                const glm::dvec2 place = place_in_map(model, camera, from_eye);
                low = glm::min(low, place);
                high = glm::max(high, place);
            }
        EXPECT_GT(std::min(low.x, low.y), 0) << name;
        EXPECT_LT(std::max(high.x, high.y), model.size) << name;
        EXPECT_GT(std::max(high.x - low.x, high.y - low.y), 0.97 * model.size) << name;
    }
}

TEST_F(SunMap, shows_range_where_its_planes_cut_the_scene_and_nowhere_else) {
    EXPECT_EQ(pixels_of(judged({}), Cause::range), 0U);
    const MapModel own = with_settings(sun_model(), {}, sun.scene);
    for (const MapSettings& cut : {MapSettings{.bias = 0.02, .far = 0.7 * own.far},
                                   MapSettings{.bias = 0.02, .near = 0.55 * own.far}}) {
        const Frame frame = drawn(gpu, sun, "sun_map", cut);
        EXPECT_EQ(texels_not_shown(sun, frame), 0U);
        const Comparison comparison = compared(sun, frame);
        EXPECT_GT(pixels_of(comparison, Cause::range), 20U);
        EXPECT_TRUE(is_explained(comparison));
    }
}

TEST_F(SunMap, of_any_size_is_explained_at_any_size_of_the_picture) {
    for (const char* name : {"sun", "grazing_light"})
        for (const int picture : {1, 17, 64}) {
            const TracedScene traced(small(name, picture));
            for (const int size : {1, 3, 61, 2048}) {
                const Frame frame = drawn(gpu, traced, "sun_map", {.size = size});
                if (size < 100) {
                    EXPECT_EQ(texels_not_shown(traced, frame), 0U) << name << " " << size;
                }
                EXPECT_TRUE(is_explained(compared(traced, frame)))
                    << name << " " << picture << " " << size;
            }
        }
}

TEST_F(SunMap, with_a_texel_a_little_beyond_its_bound_is_unexplained_and_within_it_is_not) {
    Frame frame = drawn(gpu, sun, "sun_map", {.size = 64, .format = MapFormat::d32f});
    const std::unique_ptr<LightView> light = light_view(sun.scene, *frame.mapped, 8, 0);
    const std::vector<Texel> texels = all_texels(frame.mapped->model);
    const std::vector<FromLight> at_centres = light->trace_without({}, texels);
    int tried = 0;
    int caught = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (at_centres[i].triangle == no_triangle) continue;
        float& stored = frame.mapped->faces[0].at(texels[i].x, texels[i].y);
        const float right = stored;
        stored = right * 1.0000001F;
        EXPECT_TRUE(light->shown(texels[i], at_centres[i].triangle)) << i;
        ++tried;
        // A texel's 512th on the floor is less than a thousandth of the map's reach.
        for (const float wrong : {right - 0.001F, right + 0.001F}) {
            stored = wrong;
            caught += light->shown(texels[i], at_centres[i].triangle) ? 0 : 1;
        }
        stored = right;
    }
    EXPECT_GT(tried, 1000);
    // A ball turns away at its outline, where a 512th of a texel may be as much.
    EXPECT_GT(caught, 2 * tried - tried / 50);
}

/// What is said of the map, and what is drawn, are two things.
TEST_F(SunMap, whose_settings_are_others_than_it_says_is_caught) {
    const MapSettings said{.size = 256, .bias = 0.02};
    const auto is_caught = [&](auto change) {
        MapSettings other = said;
        change(other);
        Frame frame = drawn(gpu, sun, "sun_map", other);
        frame.mapped->model = with_settings(sun_model(), said, sun.scene);
        return !is_explained(compared(sun, frame));
    };
    EXPECT_FALSE(is_caught([](MapSettings&) {}));
    EXPECT_TRUE(is_caught([](MapSettings& s) { s.bias = 0.03; }));
    EXPECT_TRUE(is_caught([](MapSettings& s) { s.bias = 0; }));
    EXPECT_TRUE(is_caught([](MapSettings& s) { s.far = 100; }));
    EXPECT_TRUE(is_caught([](MapSettings& s) { s.near = 0.01; }));
    EXPECT_TRUE(is_caught([](MapSettings& s) { s.culling = MapCulling::front; }));
    EXPECT_TRUE(is_caught([](MapSettings& s) { s.format = MapFormat::d16; }));
}

TEST_F(SunMap, holds_the_depth_of_what_lies_under_a_texel_and_compares_it_with_the_bias) {
    const MapModel model = with_settings(sun_model(), {.bias = 0.25}, sun.scene);
    for (const double depth : {model.near, 0.5 * model.far, model.far})
        EXPECT_NEAR(value_of_stored(model, map_window_depth(model, depth)), depth, 1e-12 * depth);
    EXPECT_DOUBLE_EQ(map_window_depth(model, model.near), 0);
    EXPECT_DOUBLE_EQ(map_window_depth(model, model.far), 1);
    const double stored = map_window_depth(model, 3);
    EXPECT_FALSE(is_shadowed(model, stored, 3.2499));
    EXPECT_TRUE(is_shadowed(model, stored, 3.2501));
    const Answers tie = compare(model, stored, 3.25, 3.25);
    EXPECT_TRUE(tie.shadowed && tie.lit);
    const Answers beyond = compare(model, stored, 3.2501, 3.2501);
    EXPECT_TRUE(beyond.shadowed && !beyond.lit);
    const Answers before = compare(model, stored, 3.2499, 3.2499);
    EXPECT_TRUE(!before.shadowed && before.lit);
    // Before the near plane everything is lit.
    EXPECT_FALSE(compare(model, 0, 0.5 * model.near, 0.5 * model.near).shadowed);
}

/// A bundled scene under a sun that shines from where its light is to the middle of what it lights.
Scene under_a_sun(const std::string& name) {
    Scene scene = small(name, 64);
    glm::dvec3 sum(0);
    for (const glm::vec3& position : scene.positions) sum += glm::dvec3(position);
    Light& light = scene.lights[scene.light];
    if (light.kind != Light::Kind::directional) {
        const glm::dvec3 way = sum / static_cast<double>(scene.positions.size()) - light.position;
        light.kind = Light::Kind::directional;
        light.direction = glm::normalize(way + glm::dvec3(0.001, -0.002, 0.003));
    }
    return scene;
}

class SunOverScene : public testing::TestWithParam<std::string> {
protected:
    Gpu gpu{GlPlatform::osmesa};
    TracedScene traced{under_a_sun(GetParam())};
};

TEST_P(SunOverScene, leaves_no_texel_and_no_pixel_unexplained) {
    const double reach = with_settings(sun_model(), {}, traced.scene).far * traced.scene.unit;
    for (const MapCulling culling : all_map_cullings)
        for (const double slope_bias : {0.0, 1.1}) {
            const Frame frame = drawn(
                gpu, traced, "sun_map",
                {.size = 96, .bias = 0.001 * reach, .slope_bias = slope_bias, .culling = culling});
            EXPECT_EQ(texels_not_shown(traced, frame), 0U) << name_of(culling) << " " << slope_bias;
            EXPECT_TRUE(is_explained(compared(traced, frame)))
                << name_of(culling) << " " << slope_bias;
        }
}

SHADOWPROOF_OVER_SCENES(SunOverScene, tests::bundled_names());

} // namespace
} // namespace shadowproof
