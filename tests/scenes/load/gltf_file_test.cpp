#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

namespace shadowproof::test {
namespace {

using nlohmann::json;

// What glTF allows and tinygltf by itself drops, refuses or takes for something else.

TEST(reading, integers_may_be_written_with_a_fraction_of_zero) {
    json gltf = triangle_gltf();
    gltf["accessors"][0]["count"] = 3.0;
    gltf["nodes"][0]["mesh"] = 0.0;
    gltf["buffers"][0]["byteLength"] = 36.0;
    EXPECT_EQ(load(gltf).triangles.size(), 1U);
}

TEST(reading, a_plus_in_the_name_of_a_buffer_is_a_plus) {
    const Folder folder;
    json gltf = triangle_gltf();
    FileBytes bytes;
    for (const float value : {0.F, 0.F, 0.F, 4.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(bytes, value);
    write_bytes(folder.path() / "a+b.bin", bytes);
    gltf["buffers"][0]["uri"] = "a+b.bin";
    const std::string text = gltf.dump();
    write_bytes(folder.path() / "small.gltf", FileBytes(text.begin(), text.end()));
    EXPECT_EQ(load_gltf(folder.path() / "small.gltf", {}).positions[1], glm::vec3(4, 0, 0));
}

TEST(reading, a_buffer_may_hold_more_than_is_used_of_it) {
    json gltf = triangle_gltf();
    FileBytes bytes;
    for (const float value : {0.F, 0.F, 0.F, 5.F, 0.F, 0.F, 0.F, 1.F, 0.F, 9.F}) put(bytes, value);
    for (const std::string type : {"application/octet-stream", "application/x-own"}) {
        gltf["buffers"][0]["uri"] = "data:" + type + ";base64," + base64(bytes);
        EXPECT_EQ(load(gltf).positions[1], glm::vec3(5, 0, 0)) << type;
    }
}

TEST(reading, base64_that_stops_in_the_middle_is_refused) {
    json gltf = triangle_gltf();
    std::string uri = gltf["buffers"][0]["uri"];
    uri[uri.size() - 20] = '=';
    gltf["buffers"][0]["uri"] = uri;
    EXPECT_NE(refusal(gltf).find(" /buffers/0/uri: is not well-formed base64"), std::string::npos);
}

TEST(reading, images_are_never_looked_at_where_no_surface_has_a_bump_map) {
    json gltf = triangle_gltf();
    gltf["images"] = {{{"uri", "../../etc/passwd"}}, {{"bufferView", 99}}, 5};
    gltf["textures"] = {{{"source", 7}}};
    const json decal = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
    const json bumpy = {{"normalTexture", {{"index", 0}}}};
    gltf["materials"] = {decal, bumpy};
    gltf["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_EQ(refusal(gltf), "");
    const Scene scene = load(gltf);
    EXPECT_FALSE(is_bump_lit(scene));
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_TRUE(scene.surfaces.empty());
    gltf["meshes"][0]["primitives"][0]["material"] = 1;
    EXPECT_NE(refusal(gltf), "");
}

TEST(reading, a_channel_without_a_node_shifts_no_other) {
    json gltf = triangle_gltf();
    const json idle = {{"sampler", 0}, {"target", {{"path", "pointer"}}}};
    const json bad = {{"sampler", 7}, {"target", {{"node", 0}, {"path", "scale"}}}};
    const json sampler = {{"input", 0}, {"output", 0}};
    gltf["animations"] = json::array({{{"samplers", {sampler}}, {"channels", {idle, bad}}}});
    EXPECT_NE(refusal(gltf).find(" /animations/0/channels/1/sampler: 7 is no index"),
              std::string::npos);
}

TEST(reading, a_second_buffer_does_not_take_the_glb_chunk) {
    json gltf = triangle_gltf();
    gltf["buffers"][0].erase("uri");
    gltf["buffers"][1].erase("uri");
    const Folder folder;
    write_bytes(folder.path() / "small.glb", glb_of(gltf, FileBytes(36, 0)));
    EXPECT_NE(refusal_of_file(folder.path() / "small.glb").find(" /buffers/1: has no uri"),
              std::string::npos);
}

TEST(reading, what_only_tinygltf_refuses_is_named_by_its_pointer) {
    json gltf = triangle_gltf();
    gltf["bufferViews"][1]["byteStride"] = 7;
    EXPECT_NE(refusal(gltf).find(" /bufferViews/1: is refused by tinygltf"), std::string::npos);
    gltf = triangle_gltf();
    gltf["extensions"]["KHR_lights_punctual"]["lights"] =
        json::array({{{"type", "point"}}, {{"type", "spot"}}});
    EXPECT_NE(refusal(gltf).find(" /extensions/KHR_lights_punctual/lights/1: is refused"),
              std::string::npos);
}

TEST(reading, a_matrix_beside_a_translation_is_refused) {
    json gltf = triangle_gltf();
    gltf["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_EQ(refusal(gltf), "");
    gltf["nodes"][0]["translation"] = {0, 0, 0};
    EXPECT_NE(refusal(gltf).find(" /nodes/0: has both"), std::string::npos);
}

TEST(reading, indices_without_a_buffer_view_are_refused_where_they_are_named) {
    json gltf = triangle_gltf();
    gltf["accessors"][1].erase("bufferView");
    EXPECT_NE(refusal(gltf).find(" /meshes/0/primitives/0/indices: names an accessor without"),
              std::string::npos);
}

} // namespace
} // namespace shadowproof::test
