#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof::test {
namespace {

using nlohmann::json;

json& attributes_of(json& gltf) {
    return gltf["meshes"][0]["primitives"][0]["attributes"];
}

std::size_t add_floats(json& gltf, const std::vector<float>& values, std::size_t width) {
    FileBytes bytes;
    for (const float value : values) put(bytes, value);
    return add_accessor(gltf, bytes, 5126, values.size() / width, "VEC" + std::to_string(width));
}

/// The upright triangle in z = 0 with normals along `normal` and tangents along x.
json with_frame(const glm::vec3& normal = {0, 0, 1}) {
    json gltf = textured_gltf();
    std::vector<float> normals;
    std::vector<float> tangents;
    for (int i = 0; i < 3; ++i) {
        normals.insert(normals.end(), {normal.x, normal.y, normal.z});
        tangents.insert(tangents.end(), {1, 0, 0, 1});
    }
    attributes_of(gltf)["NORMAL"] = add_floats(gltf, normals, 3);
    attributes_of(gltf)["TANGENT"] = add_floats(gltf, tangents, 4);
    return gltf;
}

void expect_frame(const Scene& scene, const glm::vec3& normal, const glm::vec4& tangent) {
    ASSERT_EQ(scene.surfaces.size(), 3 * scene.triangles.size());
    for (const Surface& surface : scene.surfaces) {
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(surface.normal[k], normal[k], 1e-6F);
        for (int k = 0; k < 4; ++k) EXPECT_NEAR(surface.tangent[k], tangent[k], 1e-6F);
    }
}

TEST(surfaces, without_normals_are_flat_and_without_tangents_take_the_pictures) {
    const Scene scene = load(textured_gltf());
    expect_frame(scene, {0, 0, 1}, {1, 0, 0, 1});
    EXPECT_EQ(scene.surfaces[0].bump_at, glm::vec2(0, 1));
    EXPECT_EQ(scene.surfaces[2].bump_at, glm::vec2(0, 0));
}

TEST(surfaces, ignore_tangents_where_there_are_no_normals) {
    json gltf = with_frame();
    attributes_of(gltf).erase("NORMAL");
    attributes_of(gltf)["TANGENT"] = add_floats(gltf, {0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, 4);
    expect_frame(load(gltf), {0, 0, 1}, {1, 0, 0, 1});
}

TEST(surfaces, turn_with_their_node) {
    json gltf = with_frame();
    const double half = std::sqrt(0.5);
    gltf["nodes"][0]["rotation"] = {0, half, 0, half}; // z to x, x to -z
    expect_frame(load(gltf), {1, 0, 0}, {0, 0, -1, 1});
}

TEST(surfaces, keep_normals_upright_on_what_is_stretched) {
    json gltf = with_frame(glm::normalize(glm::vec3(1, 0, 1)));
    gltf["nodes"][0]["scale"] = {4, 1, 1};
    // The plane x + z = const becomes x / 4 + z = const.
    expect_frame(load(gltf), glm::normalize(glm::vec3(0.25F, 0, 1)), {1, 0, 0, 1});
}

TEST(surfaces, of_a_mirrored_node_keep_the_bitangent_that_goes_with_the_surface) {
    json gltf = with_frame();
    gltf["nodes"][0]["scale"] = {-1, 1, 1};
    const Scene scene = load(gltf);
    // What pointed right points left; up is still up: -1 * cross(z, -x) = y.
    expect_frame(scene, {0, 0, 1}, {-1, 0, 0, -1});
    // Corners follow the winding, which is restored.
    for (std::uint32_t k = 0; k < 3; ++k) {
        const glm::dvec3 place = corner(scene, 0, static_cast<int>(k));
        EXPECT_EQ(scene.surfaces[k].bump_at, glm::vec2(-place.x, 1 - place.y));
    }
    // Made from the picture, tangents are the same.
    attributes_of(gltf).erase("TANGENT");
    expect_frame(load(gltf), {0, 0, 1}, {-1, 0, 0, -1});
}

TEST(surfaces, are_moved_by_morph_targets) {
    json gltf = with_frame();
    json target;
    target["NORMAL"] = add_floats(gltf, {1, 0, 0, 1, 0, 0, 1, 0, 0}, 3);
    target["TANGENT"] = add_floats(gltf, {0, 0, -1, 0, 0, -1, 0, 0, -1}, 3);
    gltf["meshes"][0]["primitives"][0]["targets"] = {target};
    gltf["meshes"][0]["weights"] = {1};
    expect_frame(load(gltf), glm::normalize(glm::vec3(1, 0, 1)),
                 glm::vec4(glm::normalize(glm::vec3(1, 0, -1)), 1));
    gltf["meshes"][0]["weights"] = {0};
    expect_frame(load(gltf), {0, 0, 1}, {1, 0, 0, 1});
}

TEST(surfaces, without_normals_or_tangents_are_made_from_the_morphed_positions) {
    json gltf = textured_gltf();
    json target; // (0, 1, 0) goes to (0, 0, 1): the triangle now lies in y = 0
    target["POSITION"] = add_floats(gltf, {0, 0, 0, 0, 0, 0, 0, -1, 1}, 3);
    gltf["meshes"][0]["primitives"][0]["targets"] = {target};
    gltf["meshes"][0]["weights"] = {1};
    expect_frame(load(gltf), {0, -1, 0}, {1, 0, 0, 1});
}

TEST(surfaces, follow_the_joints_of_a_skin_and_not_the_node) {
    json gltf = with_frame();
    const double half = std::sqrt(0.5);
    gltf["nodes"][0]["rotation"] = {half, 0, 0, half}; // without effect
    gltf["nodes"].push_back({{"rotation", {0, half, 0, half}}});
    gltf["scenes"][0]["nodes"] = {0, 1};
    gltf["skins"] = {{{"joints", {1}}}};
    gltf["nodes"][0]["skin"] = 0;
    attributes_of(gltf)["JOINTS_0"] = add_accessor(gltf, FileBytes(12, 0), 5121, 3, "VEC4");
    attributes_of(gltf)["WEIGHTS_0"] = add_floats(gltf, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
    expect_frame(load(gltf), {1, 0, 0}, {0, 0, -1, 1});
}

TEST(surfaces, take_texture_coordinates_of_normalised_integers_and_of_the_set_that_is_named) {
    json gltf = textured_gltf();
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0},
                                                                        {"texCoord", 1}};
    attributes_of(gltf)["TEXCOORD_1"] =
        add_accessor(gltf, {0, 255, 51, 102, 0, 0}, 5121, 3, "VEC2");
    gltf["accessors"].back()["normalized"] = true;
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.surfaces[0].decal_at, glm::vec2(0, 1));
    EXPECT_EQ(scene.surfaces[1].decal_at, glm::vec2(0.2F, 0.4F));
    EXPECT_EQ(scene.surfaces[1].bump_at, glm::vec2(1, 1));
}

TEST(surfaces, of_meshes_without_a_bump_map_have_normals_beside_those_that_have_one) {
    json gltf = with_frame({0, 0.6F, 0.8F});
    gltf["materials"].push_back(json::object());
    json plain = gltf["meshes"][0]["primitives"][0];
    plain["material"] = 1;
    gltf["meshes"][0]["primitives"].push_back(plain);
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.surfaces.size(), 6U);
    EXPECT_NEAR(scene.surfaces[3].normal.y, 0.6F, 1e-6F);
    EXPECT_EQ(scene.surfaces[3].tangent, glm::vec4(0));
}

TEST(surfaces, with_a_hand_that_is_neither_left_nor_right_are_refused) {
    json gltf = with_frame();
    attributes_of(gltf)["TANGENT"] = add_floats(gltf, {1, 0, 0, 1, 1, 0, 0, 0.5F, 1, 0, 0, 1}, 4);
    EXPECT_NE(
        refusal(gltf).find(" /meshes/0/primitives/0/attributes/TANGENT: element 1 has the w 0.5"),
        std::string::npos);
}

TEST(surfaces, of_triangles_with_both_hands_take_the_first_corners_and_say_so) {
    json gltf = with_frame();
    attributes_of(gltf)["TANGENT"] = add_floats(gltf, {1, 0, 0, -1, 1, 0, 0, 1, 1, 0, 0, -1}, 4);
    const Scene scene = load(gltf);
    expect_frame(scene, {0, 0, 1}, {1, 0, 0, -1});
    EXPECT_TRUE(says(scene, "1 triangles have tangents of either hand"));
}

} // namespace
} // namespace shadowproof::test
