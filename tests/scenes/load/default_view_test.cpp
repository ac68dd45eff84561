#include "scenes/load/common/bounding_sphere.h"
#include "scenes/load/common/room.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shadowproof::test {
namespace {

using nlohmann::json;

/// A box from -half to half, wound to be seen from without or from within.
json box_gltf(const glm::vec3& half, bool inwards = false) {
    json gltf = triangle_gltf();
    std::vector<glm::vec3> corners;
    for (unsigned i = 0; i < 8; ++i)
        corners.push_back(half * glm::vec3((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1,
                                           (i & 4U) != 0 ? 1 : -1));
    FileBytes indices;
    constexpr std::uint16_t faces[][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : faces)
        for (const int k : {0, 1, 2, 0, 2, 3}) put(indices, face[inwards ? 3 - k : k]);
    json& primitive = gltf["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = add_positions(gltf, corners);
    primitive["indices"] = add_accessor(gltf, indices, 5123, 36, "SCALAR");
    return gltf;
}

SceneRequest with_floor() {
    SceneRequest request;
    request.floor = true;
    return request;
}

/// How many of 64x64 rays of the camera first meet the floor where the light does not reach it.
int shadows_seen(const Scene& scene) {
    const glm::dvec2 half = half_extent(scene.camera);
    const std::uint32_t floor = scene.meshes.back().first_triangle;
    Scene model = scene;
    model.triangles.resize(floor);
    int seen = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 ray = scene.camera.forward +
                                   scene.camera.right * (half.x * ((x + 0.5) / 32 - 1)) -
                                   scene.camera.up * (half.y * ((y + 0.5) / 32 - 1));
            const auto hit = first_hit(scene, scene.camera.eye, ray);
            const auto on_model = first_hit(model, scene.camera.eye, ray);
            if (!hit || (on_model && on_model->distance <= hit->distance)) continue;
            const glm::dvec3 point = scene.camera.eye + hit->distance * ray;
            seen += first_hit(model, point, chosen_light(scene).position - point) ? 1 : 0;
        }
    return seen;
}

TEST(default_floor, shows_the_shadow_of_what_is_wide_high_or_flat) {
    for (const glm::vec3& half :
         {glm::vec3(1, 1, 1), glm::vec3(0.1F, 2, 0.1F), glm::vec3(3, 0.05F, 1)}) {
        const Scene scene = load(box_gltf(half), with_floor());
        ASSERT_EQ(scene.meshes.size(), 2U);
        EXPECT_TRUE(says(scene, "a floor is under the model"));
        EXPECT_FALSE(scene.meshes.back().casts);
        EXPECT_LT(scene.positions.back().y, -half.y);
        EXPECT_GT(side(scene, 12, {0, 1, 0, 0}), 0); // its front is above
        EXPECT_GE(shadows_seen(scene), 20) << half.x << ' ' << half.y << ' ' << half.z;
    }
}

TEST(default_floor, is_left_out_where_it_is_not_wanted_or_the_file_has_camera_and_light) {
    EXPECT_EQ(load(box_gltf({1, 1, 1})).meshes.size(), 1U);
    json gltf = box_gltf({1, 1, 1});
    gltf["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 5}}});
    gltf["cameras"] =
        json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
    gltf["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(load(gltf, with_floor()).meshes.size(), 2U); // no light
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "point"}}});
    gltf["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const Scene scene = load(gltf, with_floor());
    EXPECT_EQ(scene.meshes.size(), 1U);
    EXPECT_FALSE(says(scene, "a floor"));
}

TEST(default_light, is_within_what_looks_inwards_and_there_is_no_floor_then) {
    const Scene room = load(box_gltf({3, 2, 4}, true), with_floor());
    EXPECT_TRUE(is_room(room));
    EXPECT_EQ(room.meshes.size(), 1U);
    EXPECT_TRUE(says(room, "a point light in their middle"));
    EXPECT_EQ(chosen_light(room).position, glm::dvec3(0, 1, 0));
    const Scene body = load(box_gltf({3, 2, 4}), with_floor());
    EXPECT_FALSE(is_room(body));
    EXPECT_GT(chosen_light(body).position.y, 2);
}

TEST(default_floor, of_a_scene_with_bump_maps_has_surfaces) {
    const Scene scene = load(textured_gltf(), with_floor());
    ASSERT_EQ(scene.surfaces.size(), 3 * scene.triangles.size());
    EXPECT_EQ(scene.surfaces.back().normal, glm::vec3(0, 1, 0));
}

json with_aspect(const json& aspect) {
    json gltf = triangle_gltf();
    gltf["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 5}}});
    gltf["cameras"] =
        json::array({{{"type", "perspective"},
                      {"perspective", {{"yfov", 1}, {"znear", 1}, {"aspectRatio", aspect}}}}});
    gltf["scenes"][0]["nodes"] = {0, 1};
    return gltf;
}

TEST(aspect_ratio, of_a_camera_decides_about_the_width_unless_a_size_is_given) {
    SceneRequest request;
    request.camera_aspect = true;
    const Scene wide = load(with_aspect(16.0 / 9), request);
    EXPECT_EQ(wide.camera.width, 910);
    EXPECT_EQ(wide.camera.height, 512);
    EXPECT_TRUE(says(wide, "910x512 pixels: the camera's aspect ratio is 1.778"));
    EXPECT_EQ(load(with_aspect(16.0 / 9)).camera.width, 512);
    EXPECT_EQ(load(triangle_gltf(), request).camera.width, 512);
    EXPECT_NE(
        refusal(with_aspect(1e9), request).find("aspectRatio: an aspect ratio of 1e+09 makes"),
        std::string::npos);
    EXPECT_NE(refusal(with_aspect(0)).find("/aspectRatio: 0 is not above 0"), std::string::npos);
}

} // namespace
} // namespace shadowproof::test
