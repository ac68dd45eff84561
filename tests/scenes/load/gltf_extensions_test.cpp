#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shadowproof::test {
namespace {

using nlohmann::json;

std::size_t add_floats(json& gltf, const std::vector<float>& values, std::size_t width) {
    FileBytes bytes;
    for (const float value : values) put(bytes, value);
    return add_accessor(gltf, bytes, 5126, values.size() / width, "VEC" + std::to_string(width));
}

json& instances_of(json& gltf) {
    return gltf["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

/// Two instances of the triangle: one where it is, one moved, turned about z by 90 degrees and
/// doubled.
json with_instances() {
    json gltf = triangle_gltf();
    instances_of(gltf)["TRANSLATION"] = add_positions(gltf, {{0, 0, 0}, {5, 0, 0}});
    const auto half = static_cast<float>(std::sqrt(0.5));
    instances_of(gltf)["ROTATION"] = add_floats(gltf, {0, 0, 0, 1, 0, 0, half, half}, 4);
    instances_of(gltf)["SCALE"] = add_positions(gltf, {{1, 1, 1}, {2, 2, 2}});
    gltf["extensionsUsed"] = gltf["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    return gltf;
}

TEST(instances, are_placed_one_by_one_in_the_nodes_space) {
    json gltf = with_instances();
    gltf["nodes"][0]["translation"] = {0, 0, 7};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.triangles.size(), 2U);
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.positions[1], glm::vec3(1, 0, 7));
    EXPECT_NEAR(scene.positions[4].x, 5, 1e-6);
    EXPECT_NEAR(scene.positions[4].y, 2, 1e-6);
    EXPECT_NEAR(scene.positions[5].x, 3, 1e-6);
    EXPECT_EQ(scene.meshes[1].name, "/nodes/0 [1]");
    EXPECT_FALSE(says(scene, "EXT_mesh_gpu_instancing"));
}

TEST(instances, that_mirror_keep_their_front) {
    json gltf = with_instances();
    instances_of(gltf)["SCALE"] = add_positions(gltf, {{1, 1, 1}, {-1, 1, 1}});
    const Scene scene = load(gltf);
    const auto toward_z = [&](std::uint32_t t) { return side(scene, t, {0, 0, 1, 0}) > 0; };
    EXPECT_TRUE(toward_z(0));
    EXPECT_TRUE(toward_z(1));
}

TEST(instances, may_be_turned_by_normalised_integers) {
    json gltf = with_instances();
    FileBytes turns;
    for (const int value : {0, 0, 0, 32767, 0, 0, 32767, 0})
        put(turns, static_cast<std::int16_t>(value));
    instances_of(gltf)["ROTATION"] = add_accessor(gltf, turns, 5122, 2, "VEC4");
    gltf["accessors"].back()["normalized"] = true;
    EXPECT_NEAR(load(gltf).positions[4].x, 3, 1e-6); // 5 - 2: half a turn about z
}

TEST(instances, that_cannot_be_placed_are_refused_by_name) {
    const std::string of_instances = "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes";
    json gltf = with_instances();
    instances_of(gltf)["SCALE"] = add_positions(gltf, {{1, 1, 1}});
    EXPECT_NE(refusal(gltf).find(of_instances + "/"), std::string::npos);
    EXPECT_NE(refusal(gltf).find("elements for"), std::string::npos);
    gltf = with_instances();
    instances_of(gltf)["ROTATION"] = add_floats(gltf, {0, 0, 0, 1, 0, 0, 0, 0}, 4);
    EXPECT_NE(refusal(gltf).find(of_instances + "/ROTATION: has no direction"), std::string::npos);
    gltf = with_instances();
    instances_of(gltf)["TRANSLATION"] = 99;
    EXPECT_NE(refusal(gltf).find(of_instances + "/TRANSLATION: 99 is no index"), std::string::npos);
    gltf = with_instances();
    instances_of(gltf) = json::object();
    EXPECT_NE(refusal(gltf).find(of_instances + ": has no attributes"), std::string::npos);
}

TEST(instances, of_many_small_meshes_are_counted_before_they_are_placed) {
    json gltf = with_instances();
    // Without a buffer view all are 0, so that a small file may ask for any number.
    gltf["accessors"].push_back({{"componentType", 5126}, {"count", 60'000'000}, {"type", "VEC3"}});
    instances_of(gltf) = {{"TRANSLATION", gltf["accessors"].size() - 1}};
    SceneRequest request;
    request.memory.bytes = 1'000'000'000;
    EXPECT_NE(refusal(gltf, request).find("its elements"), std::string::npos);
    gltf["accessors"].back()["count"] = 20'000'000;
    EXPECT_NE(refusal(gltf).find("brings the elements read above"), std::string::npos);
}

TEST(hidden_nodes, hide_meshes_and_lights_below_them_but_no_cameras) {
    json gltf = triangle_gltf();
    gltf["nodes"].push_back({{"children", {2, 3, 4}}});
    gltf["nodes"].push_back(
        {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}});
    gltf["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 3}}});
    gltf["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf["cameras"] =
        json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
    gltf["extensions"]["KHR_lights_punctual"]["lights"] =
        json::array({{{"type", "point"}, {"name", "lamp"}}});
    gltf["scenes"][0]["nodes"] = {0, 1};
    gltf["extensionsUsed"] = gltf["extensionsRequired"] = {"KHR_node_visibility"};
    EXPECT_EQ(load(gltf).triangles.size(), 2U);
    EXPECT_EQ(load(gltf).lights[0].name, "lamp");
    gltf["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.triangles.size(), 1U);
    EXPECT_EQ(scene.lights[0].name, "default");
    EXPECT_TRUE(says(scene, "no light in the file"));
    EXPECT_FALSE(says(scene, "no camera in the file"));
    EXPECT_TRUE(says(scene, "nodes that KHR_node_visibility hides are left out: 4"));
    gltf["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = 0;
    EXPECT_NE(refusal(gltf).find("/KHR_node_visibility/visible: is number, not a boolean"),
              std::string::npos);
}

TEST(scenes, that_list_children_show_them_once_where_their_parents_place_them_and_say_so) {
    json gltf = triangle_gltf();
    gltf["nodes"].push_back({{"children", {0}}, {"translation", {0, 0, 4}}});
    const Scene alone = load(gltf); // lists node 0
    EXPECT_EQ(alone.positions[0], glm::vec3(0, 0, 4));
    EXPECT_TRUE(says(alone, "/scenes/0/nodes: 1 of its nodes are children of others"));
    gltf["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(load(gltf).triangles.size(), 1U);
    gltf["scenes"][0]["nodes"] = {1};
    EXPECT_FALSE(says(load(gltf), "children of others"));
}

TEST(lights, say_that_their_range_is_not_evaluated) {
    json gltf = triangle_gltf();
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "point"}}});
    gltf["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf["scenes"][0]["nodes"] = {0, 1};
    EXPECT_FALSE(says(load(gltf), "range"));
    json& light = gltf["extensions"]["KHR_lights_punctual"]["lights"][0];
    light["range"] = 12.5;
    const Scene scene = load(gltf);
    EXPECT_TRUE(says(scene, "lights/0/range of 12.5 is not evaluated"));
    EXPECT_EQ(scene.lights.front().range * scene.unit, 12.5);
    light["range"] = -1;
    EXPECT_NE(refusal(gltf).find("/range: -1 is not above 0"), std::string::npos);
}

TEST(variants, leave_each_primitive_its_default_material_and_say_so) {
    json gltf = triangle_gltf();
    gltf["materials"] = json::array({{{"name", "plain"}}, {{"doubleSided", true}}});
    gltf["meshes"][0]["primitives"][0]["material"] = 0;
    gltf["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] =
        json::array({{{"material", 1}, {"variants", {0}}}});
    gltf["extensions"]["KHR_materials_variants"]["variants"] =
        json::array({{{"name", "day"}}, {{"name", "night"}}});
    gltf["extensionsUsed"] = {"KHR_materials_variants"};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.materials[scene.meshes[0].material].name, "plain");
    EXPECT_TRUE(says(scene, "of 2 material variants none is chosen"));
    EXPECT_FALSE(says(scene, "not evaluated"));
}

json& transform_of(json& gltf) {
    return gltf["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"];
}

TEST(texture_transforms, scale_then_rotate_then_move) {
    json gltf = textured_gltf(); // coordinates (0, 1) (1, 1) (0, 0)
    // The example of the specification: the lower left quarter of the picture.
    transform_of(gltf) = {
        {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
    const Scene scene = load(gltf);
    const glm::vec2 wanted[] = {{0.5F, 1}, {0.5F, 0.5F}, {0, 1}};
    for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k) EXPECT_NEAR(scene.surfaces[i].bump_at[k], wanted[i][k], 1e-6F);
    EXPECT_FALSE(says(scene, "KHR_texture_transform"));
    // Tangents that are made follow the picture.
    EXPECT_NEAR(scene.surfaces[0].tangent.y, -1, 1e-6F);
    EXPECT_NEAR(load(textured_gltf()).surfaces[0].tangent.x, 1, 1e-6F);
}

TEST(texture_transforms, may_name_another_set_of_coordinates) {
    json gltf = textured_gltf();
    gltf["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        add_floats(gltf, {0, 3, 4, 3, 0, 0}, 2);
    transform_of(gltf) = {{"texCoord", 1}};
    EXPECT_EQ(load(gltf).surfaces[1].bump_at, glm::vec2(4, 3));
    transform_of(gltf) = {{"texCoord", 2}};
    EXPECT_NE(refusal(gltf).find("\"TEXCOORD_2\" is missing"), std::string::npos);
    transform_of(gltf) = {{"scale", {1, 2, 3}}};
    EXPECT_NE(refusal(gltf).find("/normalTexture/extensions/KHR_texture_transform/scale: has 3"),
              std::string::npos);
    transform_of(gltf) = {{"scale", {1e300, 1}}};
    EXPECT_NE(refusal(gltf).find("coordinates that are not finite"), std::string::npos);
}

TEST(textures, in_formats_that_are_not_read_leave_visibility_alone_to_judge_and_say_so) {
    for (const char* extension : {"EXT_texture_webp", "KHR_texture_basisu"}) {
        json gltf = textured_gltf();
        EXPECT_TRUE(is_bump_lit(load(gltf)));
        gltf["textures"][0] = {{"extensions", {{extension, {{"source", 0}}}}}};
        gltf["extensionsUsed"] = gltf["extensionsRequired"] = {extension};
        const Scene scene = load(gltf);
        EXPECT_FALSE(is_bump_lit(scene));
        EXPECT_TRUE(says(scene, "/materials/0/normalTexture is in a format that is not read"));
        // A PNG beside it is read.
        gltf["textures"][0]["source"] = 0;
        EXPECT_TRUE(is_bump_lit(load(gltf)));
    }
}

TEST(textures, that_have_no_image_at_all_are_refused) {
    json gltf = textured_gltf();
    gltf["textures"][0] = json::object();
    EXPECT_NE(refusal(gltf).find("which has no PNG or JPEG image"), std::string::npos);
}

} // namespace
} // namespace shadowproof::test
