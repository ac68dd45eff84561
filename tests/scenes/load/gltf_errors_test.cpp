#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>

namespace shadowproof::test {
namespace {

using nlohmann::json;

/// One way to break the triangle, and what the message must then hold.
struct Breakage {
    const char* name; ///< letters and underscores: it becomes part of the test's name
    std::function<void(json&)> apply;
    const char* pointer; ///< with a space before it and a colon after it in the message
    const char* words;
};

[[maybe_unused]] void PrintTo(const Breakage& breakage, std::ostream* stream) {
    *stream << breakage.name;
}

class MalformedFile : public testing::TestWithParam<Breakage> {};

TEST_P(MalformedFile, is_refused_by_its_json_pointer) {
    json gltf = triangle_gltf();
    GetParam().apply(gltf);
    const std::string message = refusal(gltf);
    EXPECT_NE(message.find(std::string("small.gltf") + GetParam().pointer + ": "),
              std::string::npos)
        << message;
    EXPECT_NE(message.find(GetParam().words), std::string::npos) << message;
}

void set_position(json& gltf, float value) {
    const std::size_t accessor = add_positions(gltf, {{0, 0, 0}, {1, value, 0}, {0, 1, 0}});
    gltf["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
}

json camera_with(json perspective) {
    return json::array({{{"type", "perspective"}, {"perspective", std::move(perspective)}}});
}

json lights_with(json light) {
    return {{"KHR_lights_punctual", {{"lights", json::array({std::move(light)})}}}};
}

void use_light(json& gltf, std::size_t light) {
    gltf["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", light}}}};
}

const std::vector<Breakage> breakages{
    {"no_version", [](json& g) { g["asset"] = json::object(); }, " /asset",
     "\"version\" is missing"},
    {"gltf_1", [](json& g) { g["asset"]["version"] = "1.0"; }, " /asset/version", "not glTF 2"},
    {"root_array", [](json& g) { g = json::array(); }, "", "not an object"},
    {"scene_out_of_range", [](json& g) { g["scene"] = 7; }, " /scene", "no index into /scenes"},
    {"scene_node_out_of_range", [](json& g) { g["scenes"][0]["nodes"][0] = 3; },
     " /scenes/0/nodes/0", "no index into /nodes"},
    {"negative_mesh", [](json& g) { g["nodes"][0]["mesh"] = -1; }, " /nodes/0/mesh", "-1"},
    {"fractional_mesh", [](json& g) { g["nodes"][0]["mesh"] = 0.5; }, " /nodes/0/mesh", "0.5"},
    {"huge_mesh", [](json& g) { g["nodes"][0]["mesh"] = 4294967296ULL; }, " /nodes/0/mesh",
     "4294967296"},
    {"mesh_is_text", [](json& g) { g["nodes"][0]["mesh"] = "0"; }, " /nodes/0/mesh",
     "not a number"},
    {"self_child", [](json& g) { g["nodes"][0]["children"] = {0}; }, " /nodes/0", "cycle"},
    {"cycle_of_two",
     [](json& g) {
         g["nodes"].push_back({{"children", {2}}});
         g["nodes"].push_back({{"children", {1}}});
     },
     " /nodes/1", "cycle"},
    {"two_parents",
     [](json& g) {
         g["nodes"].push_back({{"children", {0}}});
         g["nodes"].push_back({{"children", {0}}});
     },
     " /nodes/2/children/0", "second time"},
    {"matrix_too_short",
     [](json& g) {
         g["nodes"][0]["matrix"] = {1, 0, 0};
     },
     " /nodes/0/matrix", "16"},
    {"projective_matrix",
     [](json& g) { g["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     " /nodes/0/matrix", "last row"},
    {"matrix_overflow",
     [](json& g) {
         g["nodes"][0]["scale"] = {1e300, 1e300, 1e300};
     },
     " /meshes/0/primitives/0/attributes/POSITION", "not finite in world space"},
    {"zero_rotation",
     [](json& g) {
         g["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     " /nodes/0/rotation", "no direction"},
    {"index_out_of_range",
     [](json& g) {
         g["meshes"][0]["primitives"][0]["indices"] = add_accessor(g, {0, 1, 3}, 5121, 3, "SCALAR");
     },
     " /meshes/0/primitives/0/indices", "index 3 at element 2"},
    {"signed_indices", [](json& g) { g["accessors"][1]["componentType"] = 5122; },
     " /meshes/0/primitives/0/indices", "5122"},
    {"unknown_component_type", [](json& g) { g["accessors"][0]["componentType"] = 5124; },
     " /accessors/0/componentType", "5124"},
    {"unknown_type", [](json& g) { g["accessors"][0]["type"] = "VEC5"; }, " /accessors/0/type",
     "VEC5"},
    {"position_of_wrong_type", [](json& g) { g["accessors"][0]["type"] = "VEC2"; },
     " /meshes/0/primitives/0/attributes/POSITION", "VEC2"},
    {"quantized_position_without_extension",
     [](json& g) { g["accessors"][0]["componentType"] = 5122; },
     " /meshes/0/primitives/0/attributes/POSITION", "extension"},
    {"count_beyond_buffer", [](json& g) { g["accessors"][0]["count"] = 4; }, " /accessors/0",
     "needs 48 bytes"},
    {"count_of_four_thousand_million", [](json& g) { g["accessors"][0]["count"] = 4000000000ULL; },
     " /accessors/0", "bytes"},
    {"count_without_any_buffer",
     [](json& g) {
         g["accessors"][0]["count"] = 4000000000ULL;
         g["accessors"][0].erase("bufferView");
     },
     " /meshes/0/primitives/0/attributes/POSITION", "elements read"},
    {"count_zero", [](json& g) { g["accessors"][0]["count"] = 0; }, " /accessors/0/count", "0"},
    {"offset_beyond_view", [](json& g) { g["accessors"][0]["byteOffset"] = 4; }, " /accessors/0",
     "needs 40 bytes"},
    {"negative_offset", [](json& g) { g["accessors"][0]["byteOffset"] = -4; },
     " /accessors/0/byteOffset", "-4"},
    {"view_beyond_buffer", [](json& g) { g["bufferViews"][0]["byteOffset"] = 4; },
     " /bufferViews/0", "ends at byte 40"},
    {"stride_below_element", [](json& g) { g["bufferViews"][0]["byteStride"] = 8; },
     " /bufferViews/0/byteStride", "less than"},
    {"buffer_shorter_than_said", [](json& g) { g["buffers"][0]["byteLength"] = 4000; },
     " /buffers/0/byteLength", "has 36 bytes"},
    {"absurd_buffer", [](json& g) { g["buffers"][0]["byteLength"] = 4000000000000ULL; },
     " /buffers/0/byteLength", "above"},
    {"bad_base64",
     [](json& g) { g["buffers"][0]["uri"] = "data:application/octet-stream;base64,AA?A"; },
     " /buffers/0/uri", "base64"},
    {"buffer_without_uri", [](json& g) { g["buffers"][0].erase("uri"); }, " /buffers/0", "no uri"},
    {"missing_file", [](json& g) { g["buffers"][0]["uri"] = "nowhere.bin"; }, " /buffers/0/uri",
     "does not exist"},
    {"parent_folder", [](json& g) { g["buffers"][0]["uri"] = "../outside.bin"; }, " /buffers/0/uri",
     "leaves"},
    {"encoded_parent_folder", [](json& g) { g["buffers"][0]["uri"] = "%2e%2e/outside.bin"; },
     " /buffers/0/uri", "leaves"},
    {"absolute_path", [](json& g) { g["buffers"][0]["uri"] = "/etc/passwd"; }, " /buffers/0/uri",
     "not relative"},
    {"encoded_absolute_path", [](json& g) { g["buffers"][0]["uri"] = "%2Fetc/passwd"; },
     " /buffers/0/uri", "not relative"},
    {"scheme", [](json& g) { g["buffers"][0]["uri"] = "file:///etc/passwd"; }, " /buffers/0/uri",
     "not relative"},
    {"folder_as_file", [](json& g) { g["buffers"][0]["uri"] = "."; }, " /buffers/0/uri", ""},
    {"not_a_number_in_positions",
     [](json& g) { set_position(g, std::numeric_limits<float>::quiet_NaN()); },
     " /meshes/0/primitives/0/attributes/POSITION", "element 1 holds nan"},
    {"infinite_position", [](json& g) { set_position(g, std::numeric_limits<float>::infinity()); },
     " /meshes/0/primitives/0/attributes/POSITION", "element 1 holds inf"},
    {"material_out_of_range", [](json& g) { g["meshes"][0]["primitives"][0]["material"] = 0; },
     " /meshes/0/primitives/0/material", "no index"},
    {"unknown_mode", [](json& g) { g["meshes"][0]["primitives"][0]["mode"] = 7; },
     " /meshes/0/primitives/0/mode", "7"},
    {"no_triangles", [](json& g) { g["meshes"][0]["primitives"][0]["mode"] = 0; }, "",
     "no triangle"},
    {"required_extension", [](json& g) { g["extensionsRequired"] = {"KHR_implicit_shapes"}; },
     " /extensionsRequired/0", "KHR_implicit_shapes"},
    {"unknown_cause",
     [](json& g) {
         g["extras"]["shadowproof"]["provokes"] = {"near_plane", "moonlight"};
     },
     " /extras/shadowproof/provokes/1", "moonlight"},
    {"casting_that_is_no_boolean",
     [](json& g) { g["nodes"][0]["extras"]["shadowproof"]["casts"] = 0; },
     " /nodes/0/extras/shadowproof/casts", "is number, not a boolean"},
    {"receiving_that_is_no_boolean",
     [](json& g) { g["nodes"][0]["extras"]["shadowproof"]["receives"] = "false"; },
     " /nodes/0/extras/shadowproof/receives", "is string, not a boolean"},
    {"node_extras_that_are_no_object", [](json& g) { g["nodes"][0]["extras"]["shadowproof"] = 1; },
     " /nodes/0/extras/shadowproof", "is number, not an object"},
    {"camera_out_of_range", [](json& g) { g["nodes"][0]["camera"] = 0; }, " /nodes/0/camera",
     "no index"},
    {"orthographic_camera",
     [](json& g) {
         g["nodes"][0]["camera"] = 0;
         g["cameras"] = json::array({{{"type", "orthographic"}}});
     },
     " /cameras/0/orthographic", "is missing"},
    {"near_plane_behind_the_eye",
     [](json& g) {
         g["nodes"][0]["camera"] = 0;
         g["cameras"] = camera_with({{"yfov", 1}, {"znear", 0}});
     },
     " /cameras/0/perspective/znear", "not above 0"},
    {"far_before_near",
     [](json& g) {
         g["nodes"][0]["camera"] = 0;
         g["cameras"] = camera_with({{"yfov", 1}, {"znear", 2}, {"zfar", 1}});
     },
     " /cameras/0/perspective/zfar", "not above znear"},
    {"field_of_view_too_wide",
     [](json& g) {
         g["nodes"][0]["camera"] = 0;
         g["cameras"] = camera_with({{"yfov", 4}, {"znear", 1}});
     },
     " /cameras/0/perspective/yfov", "between 0 and pi"},
    {"camera_without_direction",
     [](json& g) {
         g["nodes"][0]["camera"] = 0;
         g["nodes"][0]["scale"] = {1, 1, 0};
         g["cameras"] = camera_with({{"yfov", 1}, {"znear", 1}});
     },
     " /nodes/0", "no direction"},
    {"light_that_is_not_there", [](json& g) { use_light(g, 0); },
     " /nodes/0/extensions/KHR_lights_punctual/light", "none"},
    {"light_out_of_range",
     [](json& g) {
         g["extensions"] = lights_with({{"type", "point"}});
         use_light(g, 1);
     },
     " /nodes/0/extensions/KHR_lights_punctual/light", "no index"},
    {"unknown_light",
     [](json& g) {
         g["extensions"] = lights_with({{"type", "area"}});
         use_light(g, 0);
     },
     " /extensions/KHR_lights_punctual/lights/0/type", "area"},
    {"negative_intensity",
     [](json& g) {
         g["extensions"] = lights_with({{"type", "point"}, {"intensity", -1}});
         use_light(g, 0);
     },
     " /extensions/KHR_lights_punctual/lights/0/intensity", "negative"},
    {"sparse_index_out_of_range",
     [](json& g) {
         const std::size_t indices = add_accessor(g, {9, 0, 0, 0}, 5121, 1, "SCALAR");
         const json at = {{"bufferView", g["accessors"][indices]["bufferView"]},
                          {"componentType", 5121}};
         g["accessors"][0]["sparse"] = {
             {"count", 1}, {"indices", at}, {"values", {{"bufferView", 0}}}};
     },
     " /accessors/0/sparse/indices", "element 0 is 9"},
    {"skin_without_joints",
     [](json& g) {
         g["nodes"][0]["skin"] = 0;
         g["skins"] = json::array({{{"joints", {0}}}});
     },
     " /meshes/0/primitives/0/attributes", "JOINTS_0"},
};

INSTANTIATE_TEST_SUITE_P(table, MalformedFile, testing::ValuesIn(breakages),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST(file, deep_nesting_is_refused_before_it_is_parsed) {
    const Folder folder;
    const std::string text(200000, '[');
    write_bytes(folder.path() / "deep.gltf", FileBytes(text.begin(), text.end()));
    EXPECT_NE(refusal_of_file(folder.path() / "deep.gltf").find("nests deeper"), std::string::npos);
}

TEST(file, the_refusal_of_what_is_no_json_is_short_whatever_it_holds) {
    const Folder folder;
    const auto refusal_of = [&](const std::string& text) {
        write_bytes(folder.path() / "no.gltf", FileBytes(text.begin(), text.end()));
        return refusal_of_file(folder.path() / "no.gltf");
    };
    const std::string endless = refusal_of("{\"uri\": \"" + std::string(100000, 'A') + "\x01\"}");
    EXPECT_NE(endless.find("is not JSON at byte 100010"), std::string::npos) << endless;
    EXPECT_LT(endless.size(), 500U);
    EXPECT_NE(refusal_of("{\"byteLength\": 1e999}").find("beyond every double"), std::string::npos);
}

TEST(file, a_link_out_of_the_folder_is_not_followed) {
    const Folder outside;
    const Folder folder;
    write_bytes(outside.path() / "secret.bin", FileBytes(36, 0));
    std::filesystem::create_symlink(outside.path(), folder.path() / "link");
    json gltf = triangle_gltf();
    gltf["buffers"][0]["uri"] = "link/secret.bin";
    const std::string text = gltf.dump();
    write_bytes(folder.path() / "small.gltf", FileBytes(text.begin(), text.end()));
    EXPECT_NE(refusal_of_file(folder.path() / "small.gltf").find("leaves"), std::string::npos);
}

TEST(file, a_percent_encoded_buffer_beside_the_asset_is_read) {
    const Folder folder;
    json gltf = triangle_gltf();
    FileBytes bytes;
    for (const float value : {0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 0.F, 2.F, 0.F}) put(bytes, value);
    write_bytes(folder.path() / "my buffer.bin", bytes);
    gltf["buffers"][0]["uri"] = "my%20buffer.bin";
    const std::string text = gltf.dump();
    write_bytes(folder.path() / "small.gltf", FileBytes(text.begin(), text.end()));
    EXPECT_EQ(load_gltf(folder.path() / "small.gltf", {}).positions[1], glm::vec3(2, 0, 0));
}

TEST(file, what_is_no_regular_file_is_refused) {
    const Folder folder;
    EXPECT_NE(refusal_of_file(folder.path()).find("not a regular file"), std::string::npos);
    EXPECT_NE(refusal_of_file("/dev/zero").find("not a regular file"), std::string::npos);
    EXPECT_NE(refusal_of_file(folder.path() / "none.gltf").find("does not exist"),
              std::string::npos);
}

} // namespace
} // namespace shadowproof::test
