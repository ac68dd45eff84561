#include "scenes/bundled/author/png.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

namespace shadowproof::test {
namespace {

using nlohmann::json;

/// The textured triangle without its bumps: its texture, of these alphas, is a mask.
json masked_gltf(const std::vector<std::uint16_t>& alphas) {
    json gltf = textured_gltf();
    std::vector<std::uint16_t> values;
    for (const std::uint16_t alpha : alphas) values.insert(values.end(), {9, 9, 9, alpha});
    gltf["images"][0] = {
        {"uri", "data:image/png;base64," + base64(author::png_of({2, 2, 4, 8, values}))}};
    json& material = gltf["materials"][0];
    material.erase("normalTexture");
    material["alphaMode"] = "MASK";
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    return gltf;
}

TEST(AlphaMasks, are_read_with_their_cutoff_sampler_and_coordinates) {
    json gltf = masked_gltf({0, 51, 102, 255});
    gltf["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
    gltf["textures"][0]["sampler"] = 0;
    gltf["materials"][0]["alphaCutoff"] = 0.25;
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.masks.size(), 1U);
    EXPECT_EQ(scene.materials[0].mask, 0U);
    EXPECT_FALSE(is_bump_lit(scene));
    const AlphaMask& mask = scene.masks[0];
    EXPECT_EQ(mask.alpha.at(1, 0), 51 / 255.F);
    EXPECT_EQ(mask.alpha.at(0, 1), 102 / 255.F);
    EXPECT_EQ(mask.wrap_s, Wrap::clamp_to_edge);
    EXPECT_EQ(mask.wrap_t, Wrap::mirrored_repeat);
    EXPECT_TRUE(mask.nearest);
    EXPECT_EQ(mask.least, 0.5) << "the cutoff over the factor";
    ASSERT_EQ(scene.mask_at.size(), scene.positions.size());
    EXPECT_EQ(scene.mask_at[0], glm::vec2(0, 1));
    EXPECT_EQ(scene.mask_at[2], glm::vec2(0, 0));
}

TEST(AlphaMasks, have_their_coordinates_transformed) {
    json gltf = masked_gltf({0, 51, 102, 255});
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        {"KHR_texture_transform", {{"scale", {2, 4}}, {"offset", {0.5, 0.25}}}}};
    EXPECT_EQ(load(gltf).mask_at[0], glm::vec2(0.5, 4.25));
}

TEST(AlphaMasks, that_leave_nothing_out_are_none) {
    EXPECT_TRUE(load(masked_gltf({128, 129, 200, 255})).masks.empty()) << "0.5 by default";
    json gltf = masked_gltf({0, 0, 0, 0});
    gltf["materials"][0]["alphaCutoff"] = 0;
    EXPECT_TRUE(load(gltf).masks.empty());
    gltf = masked_gltf({0, 0, 0, 0});
    gltf["materials"][0].erase("pbrMetallicRoughness");
    EXPECT_TRUE(load(gltf).masks.empty()) << "without a texture alpha is the factor's, 1";
    gltf = masked_gltf({0, 0, 0, 0});
    gltf["materials"][0]["alphaMode"] = "BLEND";
    const Scene scene = load(gltf);
    EXPECT_TRUE(scene.masks.empty());
    EXPECT_TRUE(says(scene, "alphaMode BLEND is drawn as opaque"));
}

TEST(AlphaMasks, of_one_texture_are_one_where_their_cutoff_is) {
    json gltf = masked_gltf({0, 51, 102, 255});
    gltf["materials"].push_back(gltf["materials"][0]);
    gltf["materials"].push_back(gltf["materials"][0]);
    gltf["materials"][2]["alphaCutoff"] = 0.25;
    for (int i = 1; i < 3; ++i) {
        gltf["meshes"][0]["primitives"].push_back(gltf["meshes"][0]["primitives"][0]);
        gltf["meshes"][0]["primitives"].back()["material"] = i;
    }
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.masks.size(), 2U);
    EXPECT_EQ(scene.materials[0].mask, scene.materials[1].mask);
    EXPECT_EQ(scene.masks[scene.materials[2].mask].least, 0.25);
    EXPECT_EQ(scene.masks[0].alpha.pixels, scene.masks[1].alpha.pixels);
}

TEST(AlphaMasks, that_leave_nothing_standing_take_the_mesh_away) {
    json gltf = masked_gltf({0, 60, 127, 127});
    EXPECT_NE(refusal(gltf).find("has alpha masks that leave none of its triangles"),
              std::string::npos);
    gltf["meshes"][0]["primitives"].push_back(gltf["meshes"][0]["primitives"][0]);
    gltf["meshes"][0]["primitives"][1].erase("material");
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.triangles.size(), 1U);
    EXPECT_TRUE(says(scene, "its alpha mask leaves nothing of it"));
}

TEST(AlphaMasks, without_what_they_need_are_refused_by_name) {
    json gltf = masked_gltf({0, 51, 102, 255});
    gltf["materials"][0]["alphaCutoff"] = -0.5;
    EXPECT_NE(refusal(gltf).find("/materials/0/alphaCutoff: is negative"), std::string::npos)
        << refusal(gltf);
    gltf["materials"][0]["alphaCutoff"] = "half";
    EXPECT_NE(refusal(gltf).find("/materials/0/alphaCutoff"), std::string::npos);
    gltf = masked_gltf({0, 51, 102, 255});
    gltf["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    EXPECT_NE(refusal(gltf).find("\"TEXCOORD_0\" is missing"), std::string::npos) << refusal(gltf);
    gltf = masked_gltf({0, 51, 102, 255});
    gltf["images"][0] = {{"uri", "no such picture.png"}};
    EXPECT_NE(refusal(gltf).find("no such picture.png"), std::string::npos);
}

TEST(AlphaMasks, of_a_texture_that_is_not_read_leave_nothing_out) {
    json gltf = masked_gltf({0, 51, 102, 255});
    gltf["textures"][0].erase("source");
    gltf["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 0}}}};
    const Scene scene = load(gltf);
    EXPECT_TRUE(scene.masks.empty());
    EXPECT_TRUE(says(scene, "alphaMode MASK is drawn as opaque, for "));
}

} // namespace
} // namespace shadowproof::test
