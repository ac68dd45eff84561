#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

namespace shadowproof::test {
namespace {

using nlohmann::json;

std::size_t add_floats(json& gltf, const std::vector<float>& values, const std::string& type,
                       std::size_t components) {
    FileBytes bytes;
    for (const float value : values) put(bytes, value);
    return add_accessor(gltf, bytes, 5126, values.size() / components, type);
}

/// Node 0's `path` animated over the seconds 1 and 3.
json animated(const std::string& path, const std::string& interpolation,
              const std::vector<float>& values, const std::string& type, std::size_t components) {
    json gltf = triangle_gltf();
    const std::size_t input = add_floats(gltf, {1, 3}, "SCALAR", 1);
    const std::size_t output = add_floats(gltf, values, type, components);
    const json sampler = {{"input", input}, {"output", output}, {"interpolation", interpolation}};
    const json channel = {{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}};
    gltf["animations"] =
        json::array({{{"samplers", json::array({sampler})}, {"channels", json::array({channel})}}});
    return gltf;
}

glm::vec3 second_vertex(const json& gltf, double time) {
    SceneRequest request;
    request.time = time;
    return load(gltf, request).positions[1];
}

TEST(pose, linear_keys_are_mixed_and_held_at_the_ends) {
    const json gltf = animated("translation", "LINEAR", {0, 0, 0, 8, 0, 0}, "VEC3", 3);
    EXPECT_EQ(second_vertex(gltf, 0), glm::vec3(1, 0, 0));
    EXPECT_EQ(second_vertex(gltf, 1.5), glm::vec3(3, 0, 0));
    EXPECT_EQ(second_vertex(gltf, 99), glm::vec3(9, 0, 0));
}

TEST(pose, a_step_holds_until_the_next_key) {
    const json gltf = animated("translation", "STEP", {0, 0, 0, 8, 0, 0}, "VEC3", 3);
    EXPECT_EQ(second_vertex(gltf, 2.99), glm::vec3(1, 0, 0));
    EXPECT_EQ(second_vertex(gltf, 3), glm::vec3(9, 0, 0));
}

TEST(pose, a_cubic_spline_follows_its_tangents) {
    // Value 0 leaving with 4 a second, value 8 reached with 0: at the middle of 2 s,
    // 0.5 * 0 + 2 * 0.125 * 4 + 0.5 * 8 + 0 = 5.
    const json gltf = animated("translation", "CUBICSPLINE",
                               {0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0, 0}, "VEC3", 3);
    EXPECT_EQ(second_vertex(gltf, 2), glm::vec3(6, 0, 0));
}

TEST(pose, rotations_turn_at_even_speed) {
    // From none to a quarter turn about z.
    const json gltf =
        animated("rotation", "LINEAR", {0, 0, 0, 1, 0, 0, 0.70710678F, 0.70710678F}, "VEC4", 4);
    const glm::vec3 half = second_vertex(gltf, 2);
    EXPECT_NEAR(half.x, 0.70710678, 1e-6);
    EXPECT_NEAR(half.y, 0.70710678, 1e-6);
}

TEST(pose, morph_targets_move_vertices_by_their_weights) {
    json gltf = animated("weights", "LINEAR", {0, 1}, "SCALAR", 1);
    const std::size_t target = add_positions(gltf, {{0, 0, 0}, {0, 0, 6}, {0, 0, 0}});
    gltf["meshes"][0]["primitives"][0]["targets"] = json::array({{{"POSITION", target}}});
    EXPECT_EQ(second_vertex(gltf, 1), glm::vec3(1, 0, 0));
    EXPECT_EQ(second_vertex(gltf, 2), glm::vec3(1, 0, 3));
}

TEST(pose, a_skin_follows_its_joints_and_not_its_node) {
    json gltf = triangle_gltf();
    gltf["nodes"][0]["skin"] = 0;
    gltf["nodes"][0]["translation"] = {100, 0, 0}; // has no part in it
    gltf["nodes"].push_back({{"translation", {0, 0, 2}}});
    gltf["nodes"].push_back({{"translation", {0, 0, 4}}});
    gltf["scenes"][0]["nodes"] = {0, 1, 2};
    gltf["skins"] = json::array({{{"joints", {1, 2}}}});
    json& attributes = gltf["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] =
        add_accessor(gltf, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5121, 3, "VEC4");
    attributes["WEIGHTS_0"] =
        add_floats(gltf, {1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 0, 1, 0, 0}, "VEC4", 4);
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.positions[0], glm::vec3(0, 0, 2));
    EXPECT_EQ(scene.positions[1], glm::vec3(1, 0, 3));
    EXPECT_EQ(scene.positions[2], glm::vec3(0, 1, 4));
}

TEST(pose, key_frames_out_of_order_are_refused) {
    json gltf = animated("translation", "LINEAR", {0, 0, 0, 8, 0, 0}, "VEC3", 3);
    gltf["animations"][0]["samplers"][0]["input"] = add_floats(gltf, {3, 1}, "SCALAR", 1);
    EXPECT_NE(refusal(gltf).find("/animations/0/samplers/0/input: key frame 1"), std::string::npos);
}

} // namespace
} // namespace shadowproof::test
