#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof::test {
namespace {

using nlohmann::json;

/// The triangle, two perspective cameras and an orthographic one before them, three lights.
json furnished() {
    json gltf = triangle_gltf();
    gltf["cameras"] =
        json::array({{{"type", "orthographic"},
                      {"name", "plan"},
                      {"orthographic", {{"xmag", 6}, {"ymag", 4}, {"znear", 0}, {"zfar", 30}}}},
                     {{"type", "perspective"},
                      {"name", "wide"},
                      {"perspective", {{"yfov", 1.5}, {"znear", 1}}}},
                     {{"type", "perspective"},
                      {"name", "narrow"},
                      {"perspective", {{"yfov", 0.5}, {"znear", 0.25}, {"zfar", 80}}}}});
    gltf["extensions"]["KHR_lights_punctual"]["lights"] =
        json::array({{{"type", "point"}, {"name", "lamp"}},
                     {{"type", "directional"}, {"name", "sun"}},
                     {{"type", "spot"}, {"name", "torch"}, {"spot", {{"outerConeAngle", 0.5}}}}});
    for (int camera = 0; camera < 3; ++camera) {
        gltf["nodes"].push_back({{"camera", camera}, {"translation", {0, 0, 5 + camera}}});
        gltf["scenes"][0]["nodes"].push_back(gltf["nodes"].size() - 1);
    }
    for (int light = 0; light < 3; ++light) {
        gltf["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}},
                                 {"rotation", {0, 1, 0, 0}},
                                 {"translation", {light, 2, 3}}});
        gltf["scenes"][0]["nodes"].push_back(gltf["nodes"].size() - 1);
    }
    return gltf;
}

TEST(camera, the_first_perspective_one_is_taken_and_the_orthographic_one_said) {
    const Scene scene = load(furnished());
    EXPECT_EQ(scene.camera.eye, glm::dvec3(0, 0, 6));
    EXPECT_EQ(scene.camera.forward, glm::dvec3(0, 0, -1));
    EXPECT_DOUBLE_EQ(scene.camera.half_height, std::tan(0.75));
    EXPECT_TRUE(std::isinf(scene.camera.far));
    EXPECT_TRUE(says(scene, "orthographic"));
}

TEST(camera, an_orthographic_one_is_read_and_taken_where_there_is_no_other) {
    SceneRequest request;
    request.camera = "plan";
    request.camera_aspect = true;
    json gltf = furnished();
    const Camera camera = load(gltf, request).camera;
    EXPECT_TRUE(camera.is_orthographic());
    EXPECT_EQ(camera.eye, glm::dvec3(0, 0, 5));
    EXPECT_EQ(camera.half_height, 4);
    EXPECT_EQ(camera.width, 768);
    EXPECT_EQ(camera.near, 0);
    EXPECT_EQ(camera.far, 30);
    for (int other = 2; other < 4; ++other) gltf["nodes"][other].erase("camera");
    EXPECT_TRUE(load(gltf).camera.is_orthographic());
    EXPECT_TRUE(says(load(gltf), "its ymag is kept"));
}

TEST(camera, an_orthographic_one_without_extent_or_with_planes_askew_is_refused) {
    const auto refused = [](const char* member, double value) {
        json gltf = furnished();
        gltf["cameras"][0]["orthographic"][member] = value;
        SceneRequest request;
        request.camera = "plan";
        return refusal(gltf, request);
    };
    EXPECT_NE(refused("xmag", 0).find("/cameras/0/orthographic/xmag: 0 is not above 0"),
              std::string::npos);
    EXPECT_NE(refused("ymag", -4).find("/ymag: -4 is not above 0"), std::string::npos);
    EXPECT_NE(refused("znear", -1).find("/znear: -1 is negative"), std::string::npos);
    EXPECT_NE(refused("znear", 30).find("/zfar: 30 is not above znear 30"), std::string::npos);
}

TEST(camera, whose_aspect_ratio_is_not_the_pictures_is_said) {
    const auto says_of = [](double aspect, int width, int height) {
        json gltf = furnished();
        gltf["cameras"][1]["perspective"]["aspectRatio"] = aspect;
        SceneRequest request;
        request.width = width;
        request.height = height;
        return says(load(gltf, request), "aspect ratio");
    };
    EXPECT_TRUE(says_of(1.5, 512, 512));
    EXPECT_FALSE(says_of(1.5, 300, 200));
    EXPECT_FALSE(says_of(1920.0 / 1080, 512, 288));
    EXPECT_FALSE(says(load(furnished()), "aspect ratio"));
}

TEST(camera, one_is_chosen_by_name_or_number) {
    SceneRequest request;
    request.camera = "narrow";
    EXPECT_EQ(load(furnished(), request).camera.far, 80);
    request.camera = "2";
    EXPECT_EQ(load(furnished(), request).camera.near, 0.25);
    request.camera = "3";
    EXPECT_NE(refusal(furnished(), request).find("has no camera \"3\""), std::string::npos);
    EXPECT_NE(refusal(triangle_gltf(), request).find("there is no camera"), std::string::npos);
}

TEST(camera, its_axes_stay_orthonormal_under_scale) {
    json gltf = furnished();
    gltf["nodes"][2]["scale"] = {3, -2, 5};
    gltf["nodes"][2]["rotation"] = {0.5, 0.5, 0.5, 0.5};
    const Camera camera = load(gltf).camera;
    EXPECT_NEAR(glm::length(camera.right), 1, 1e-15);
    EXPECT_NEAR(glm::dot(camera.right, camera.up), 0, 1e-15);
    EXPECT_NEAR(glm::dot(glm::cross(camera.right, camera.up), camera.forward), -1, 1e-15);
}

TEST(light, all_are_read_and_the_first_is_judged) {
    const Scene scene = load(furnished());
    ASSERT_EQ(scene.lights.size(), 3U);
    EXPECT_EQ(chosen_light(scene).name, "lamp");
    EXPECT_EQ(chosen_light(scene).position, glm::dvec3(0, 2, 3));
    EXPECT_EQ(scene.lights[1].kind, Light::Kind::directional);
    EXPECT_NEAR(scene.lights[1].direction.z, 1, 1e-15); // half a turn from -z
    EXPECT_EQ(scene.lights[2].outer_cone, 0.5);
}

TEST(light, a_directional_one_is_looked_for_where_its_rays_come_from) {
    const Scene scene = load(furnished());
    EXPECT_EQ(homogeneous(scene.lights[0]), glm::dvec4(0, 2, 3, 1));
    EXPECT_EQ(homogeneous(scene.lights[1]), glm::dvec4(-scene.lights[1].direction, 0));
    EXPECT_EQ(homogeneous(scene.lights[2]).w, 1);
}

TEST(default_framing, shows_every_vertex_in_any_shape_of_picture) {
    for (const auto& [width, height] : {std::pair(512, 512), std::pair(100, 700), {900, 60}}) {
        SceneRequest request;
        request.width = width;
        request.height = height;
        const Scene scene = load(triangle_gltf(), request);
        EXPECT_TRUE(says(scene, "no camera in the file"));
        EXPECT_TRUE(says(scene, "no light in the file"));
        for (const glm::dvec3 position : scene.positions) {
            EXPECT_GT(view_depth(scene.camera, position), scene.camera.near);
            const glm::dvec2 place = project(scene.camera, position);
            EXPECT_TRUE(place.x > 0 && place.x < width && place.y > 0 && place.y < height);
        }
        const glm::dvec3 to_light = chosen_light(scene).position - scene.camera.eye;
        EXPECT_GT(chosen_light(scene).position.y, scene.positions[2].y);
        EXPECT_LT(glm::dot(to_light, scene.camera.right), 0);
    }
}

} // namespace
} // namespace shadowproof::test
