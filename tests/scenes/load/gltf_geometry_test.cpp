#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

namespace shadowproof::test {
namespace {

using nlohmann::json;

json& primitive_of(json& gltf) {
    return gltf["meshes"][0]["primitives"][0];
}

glm::dvec3 normal(const Scene& scene, std::uint32_t triangle) {
    return glm::cross(corner(scene, triangle, 1) - corner(scene, triangle, 0),
                      corner(scene, triangle, 2) - corner(scene, triangle, 0));
}

TEST(baking, a_triangle_comes_out_as_it_went_in) {
    const Scene scene = load(triangle_gltf());
    ASSERT_EQ(scene.positions.size(), 3U);
    EXPECT_EQ(scene.positions[1], glm::vec3(1, 0, 0));
    ASSERT_EQ(scene.triangles.size(), 1U);
    EXPECT_EQ(scene.triangles[0], glm::uvec3(0, 1, 2));
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_FALSE(scene.materials[scene.meshes[0].material].double_sided);
}

TEST(baking, every_index_type_reads_the_same_triangle) {
    for (const auto& [type, bytes] :
         {std::pair(5121, FileBytes{0, 1, 2}), std::pair(5123, FileBytes{0, 0, 1, 0, 2, 0}),
          std::pair(5125, FileBytes{0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0})}) {
        json gltf = triangle_gltf();
        primitive_of(gltf)["indices"] = add_accessor(gltf, bytes, type, 3, "SCALAR");
        EXPECT_EQ(load(gltf).triangles[0], glm::uvec3(0, 1, 2)) << type;
    }
}

TEST(baking, without_indices_vertices_follow_each_other) {
    json gltf = triangle_gltf();
    primitive_of(gltf).erase("indices");
    EXPECT_EQ(load(gltf).triangles[0], glm::uvec3(0, 1, 2));
}

TEST(baking, strips_and_fans_keep_their_winding) {
    json gltf = triangle_gltf();
    primitive_of(gltf).erase("indices");
    primitive_of(gltf)["attributes"]["POSITION"] =
        add_positions(gltf, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}});
    primitive_of(gltf)["mode"] = 5;
    const Scene strip = load(gltf);
    ASSERT_EQ(strip.triangles.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_GT(normal(strip, i).z, 0) << i;

    primitive_of(gltf)["attributes"]["POSITION"] =
        add_positions(gltf, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}});
    primitive_of(gltf)["mode"] = 6;
    const Scene fan = load(gltf);
    ASSERT_EQ(fan.triangles.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_GT(normal(fan, i).z, 0) << i;
}

TEST(baking, a_mirroring_node_turns_its_triangles_over) {
    json gltf = triangle_gltf();
    gltf["nodes"][0]["scale"] = {-1, 1, 1};
    EXPECT_GT(normal(load(gltf), 0).z, 0);
    gltf["nodes"][0]["scale"] = {-1, -1, 1}; // a half turn mirrors nothing
    EXPECT_GT(normal(load(gltf), 0).z, 0);
    gltf["nodes"][0]["scale"] = {1, 1, -1}; // the plane stays, its front is now behind
    EXPECT_LT(normal(load(gltf), 0).z, 0);
}

TEST(baking, transforms_multiply_down_the_tree) {
    json gltf = triangle_gltf();
    gltf["nodes"].push_back({{"children", {0}},
                             {"translation", {10, 0, 0}},
                             {"rotation", {0, 0, 0.7071067811865476, 0.7071067811865476}},
                             {"scale", {2, 2, 2}}});
    gltf["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 3, 0, 1};
    gltf["scenes"][0]["nodes"] = {1};
    // (1,0,0) -> moved (1,3,0) -> doubled (2,6,0) -> turned (-6,2,0) -> moved (4,2,0)
    const glm::vec3 placed = load(gltf).positions[1];
    EXPECT_NEAR(placed.x, 4, 1e-6);
    EXPECT_NEAR(placed.y, 2, 1e-6);
}

TEST(baking, a_node_outside_the_scene_is_not_drawn) {
    json gltf = triangle_gltf();
    gltf["nodes"].push_back({{"mesh", 0}});
    EXPECT_EQ(load(gltf).triangles.size(), 1U);
    gltf.erase("scenes"); // then every root is
    gltf.erase("scene");
    EXPECT_EQ(load(gltf).triangles.size(), 2U);
}

TEST(accessors, strides_and_offsets_are_followed) {
    json gltf = triangle_gltf();
    FileBytes bytes;
    for (const float x : {9.F, 0.F, 5.F, 7.F}) // each vertex (x, 1, 2), then 4 bytes of padding
        for (const float value : {x, 1.F, 2.F, -1.F}) put(bytes, value);
    const std::size_t accessor = add_accessor(gltf, bytes, 5126, 3, "VEC3");
    gltf["accessors"][accessor]["byteOffset"] = 16;
    gltf["bufferViews"].back()["byteStride"] = 16;
    primitive_of(gltf)["attributes"]["POSITION"] = accessor;
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.positions[0], glm::vec3(0, 1, 2));
    EXPECT_EQ(scene.positions[2], glm::vec3(7, 1, 2));
}

TEST(accessors, sparse_values_replace_those_below_or_zeros) {
    json gltf = triangle_gltf();
    FileBytes place{1};
    FileBytes value;
    for (const float coordinate : {4.F, 5.F, 6.F}) put(value, coordinate);
    const std::size_t places = add_accessor(gltf, place, 5121, 1, "SCALAR");
    const std::size_t values = add_accessor(gltf, value, 5126, 1, "VEC3");
    gltf["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices",
         {{"bufferView", gltf["accessors"][places]["bufferView"]}, {"componentType", 5121}}},
        {"values", {{"bufferView", gltf["accessors"][values]["bufferView"]}}}};
    const Scene over = load(gltf);
    EXPECT_EQ(over.positions[1], glm::vec3(4, 5, 6));
    EXPECT_EQ(over.positions[2], glm::vec3(0, 1, 0));
    gltf["accessors"][0].erase("bufferView");
    EXPECT_EQ(load(gltf).positions[2], glm::vec3(0, 0, 0));
}

TEST(accessors, quantized_positions_are_read_plain_and_normalized) {
    json gltf = triangle_gltf();
    gltf["extensionsUsed"] = {"KHR_mesh_quantization"};
    gltf["extensionsRequired"] = {"KHR_mesh_quantization"};
    // Signed bytes, padded to four: (0,0,0) (127,0,0) (0,-128,0).
    const std::size_t accessor =
        add_accessor(gltf, {0, 0, 0, 0, 127, 0, 0, 0, 0, 128, 0, 0}, 5120, 3, "VEC3");
    gltf["bufferViews"].back()["byteStride"] = 4;
    primitive_of(gltf)["attributes"]["POSITION"] = accessor;
    EXPECT_EQ(load(gltf).positions[1], glm::vec3(127, 0, 0));
    gltf["accessors"][accessor]["normalized"] = true;
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.positions[2], glm::vec3(0, -1, 0)); // -128/127 is cut to -1
}

TEST(glb, holds_the_same_scene) {
    json gltf = triangle_gltf();
    FileBytes binary;
    for (const float value : {0.F, 0.F, 0.F, 3.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(binary, value);
    gltf["buffers"][0].erase("uri");
    const Folder folder;
    const auto file = folder.path() / "small.glb";
    write_bytes(file, glb_of(gltf, binary));
    EXPECT_EQ(load_gltf(file, {}).positions[1], glm::vec3(3, 0, 0));
}

TEST(glb, chunks_that_do_not_fit_are_refused) {
    json gltf = triangle_gltf();
    const Folder folder;
    const auto file = folder.path() / "small.glb";
    const FileBytes whole = glb_of(gltf, FileBytes(36, 0));
    const auto refusal_with = [&](std::size_t offset, std::uint8_t value) {
        FileBytes bytes = whole;
        bytes[offset] = value;
        write_bytes(file, bytes);
        return refusal_of_file(file);
    };
    EXPECT_NE(refusal_with(4, 1).find("version 1"), std::string::npos);
    EXPECT_NE(refusal_with(8, 0).find("says it has"), std::string::npos);
    EXPECT_NE(refusal_with(15, 0x7f).find("are left"), std::string::npos);
    EXPECT_NE(refusal_with(16, 'X').find("JSON chunk"), std::string::npos);
    for (std::size_t size = 0; size < 28; ++size) {
        write_bytes(file,
                    FileBytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
        EXPECT_FALSE(refusal_of_file(file).empty()) << size;
    }
}

TEST(notes, say_what_is_not_evaluated) {
    json gltf = triangle_gltf();
    gltf["materials"] = json::array({{{"alphaMode", "BLEND"}, {"doubleSided", true}}});
    primitive_of(gltf)["material"] = 0;
    gltf["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
    gltf["extensionsUsed"] = {"EXT_lights_ies"};
    const Scene scene = load(gltf);
    EXPECT_TRUE(scene.materials[scene.meshes[0].material].double_sided);
    EXPECT_TRUE(says(scene, "alphaMode BLEND is drawn as opaque"));
    EXPECT_TRUE(says(scene, "/meshes/0/primitives/1: points and lines are left out"));
    EXPECT_TRUE(says(scene, "EXT_lights_ies is not evaluated"));
    EXPECT_FALSE(says(load(triangle_gltf()), "not evaluated"));
}

/// A chain of nodes with the triangle in each, and `says` as the extras of each.
std::vector<Mesh> meshes_of_chain(const std::vector<json>& says) {
    json gltf = triangle_gltf();
    const json node = gltf["nodes"][0];
    for (std::size_t i = 0; i < says.size(); ++i) {
        gltf["nodes"][i] = node;
        if (!says[i].is_null()) gltf["nodes"][i]["extras"] = says[i];
        if (i + 1 < says.size()) gltf["nodes"][i]["children"] = {i + 1};
    }
    return load(gltf).meshes;
}

TEST(casters, a_node_casts_and_receives_unless_it_or_the_nearest_ancestor_that_says_so_does_not) {
    const auto ours = [](json flags) { return json{{"shadowproof", std::move(flags)}}; };
    const std::vector<Mesh> meshes =
        meshes_of_chain({nullptr, ours({{"casts", false}}), "anything at all",
                         ours({{"receives", false}}), ours({{"casts", true}}), nullptr});
    const std::vector<bool> casts{true, false, false, false, true, true};
    const std::vector<bool> receives{true, true, true, false, false, false};
    ASSERT_EQ(meshes.size(), casts.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        EXPECT_EQ(meshes[i].casts, casts[i]) << i;
        EXPECT_EQ(meshes[i].receives, receives[i]) << i;
    }
}

TEST(notes, provoked_causes_are_read_from_extras) {
    json gltf = triangle_gltf();
    EXPECT_FALSE(load(gltf).declares_provokes);
    gltf["extras"]["shadowproof"]["provokes"] = {"far_plane"};
    EXPECT_EQ(load(gltf).provokes, std::vector<Cause>{Cause::far_plane});
    EXPECT_TRUE(load(gltf).may_provoke.empty());
    gltf["extras"]["shadowproof"]["provokesWide"] = {"extrusion", "cap"};
    EXPECT_TRUE(load(gltf).may_provoke.empty()) << "the picture is a square";
    SceneRequest wide;
    wide.width = 640;
    wide.height = 360;
    EXPECT_EQ(load(gltf, wide).may_provoke, (std::vector<Cause>{Cause::extrusion, Cause::cap}));
    std::swap(wide.width, wide.height);
    EXPECT_TRUE(load(gltf, wide).may_provoke.empty());
    EXPECT_EQ(load(gltf).provokes, std::vector<Cause>{Cause::far_plane});
    gltf["extras"] = "anything at all";
    EXPECT_FALSE(load(gltf).declares_provokes);
}

} // namespace
} // namespace shadowproof::test
