#include "scenes/bundled/author/png.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

namespace shadowproof::test {
namespace {

using nlohmann::json;

/// 2 x 2 texels of as many channels as the values make.
FileBytes png(const std::vector<std::uint16_t>& values, unsigned bits = 8) {
    return author::png_of({2, 2, static_cast<unsigned>(values.size() / 4), bits, values});
}

json data_uri(const FileBytes& bytes, const char* type = "image/png") {
    return {{"uri", std::string("data:") + type + ";base64," + base64(bytes)}};
}

const TextureImage& bump_map(const Scene& scene) {
    return scene.textures[scene.materials[scene.meshes[0].material].bump_map];
}

TEST(textures, of_a_data_uri_a_buffer_view_and_a_file_are_the_same) {
    const FileBytes bytes = png({0, 51, 102, 153, 204, 255, 1, 2, 3, 4, 5, 6});
    json gltf = textured_gltf();
    gltf["images"][0] = data_uri(bytes);
    const Image<glm::vec4> expected = bump_map(load(gltf)).texels;
    EXPECT_EQ(expected.at(0, 0), glm::vec4(0, 51 / 255.F, 102 / 255.F, 1));
    EXPECT_EQ(expected.at(1, 1), glm::vec4(4 / 255.F, 5 / 255.F, 6 / 255.F, 1));

    gltf["buffers"].push_back(data_uri(bytes, "application/octet-stream"));
    gltf["buffers"].back()["byteLength"] = bytes.size();
    gltf["bufferViews"].push_back(
        {{"buffer", gltf["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    gltf["images"][0] = {{"bufferView", gltf["bufferViews"].size() - 1}, {"mimeType", "image/png"}};
    EXPECT_EQ(bump_map(load(gltf)).texels.pixels, expected.pixels);

    const Folder folder;
    write_bytes(folder.path() / "a map.png", bytes);
    gltf["images"][0] = {{"uri", "a%20map.png"}};
    const std::string text = gltf.dump();
    write_bytes(folder.path() / "file.gltf", FileBytes(text.begin(), text.end()));
    EXPECT_EQ(bump_map(load_gltf(folder.path() / "file.gltf", {})).texels.pixels, expected.pixels);
}

TEST(textures, of_decals_are_decoded_from_srgb_and_their_alpha_and_normals_are_not) {
    json gltf = textured_gltf();
    const std::vector<std::uint16_t> values(16, 188);
    gltf["images"][0] = data_uri(png(values));
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 0.125, 1};
    const Scene scene = load(gltf);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.color, glm::dvec3(0.5, 0.25, 0.125));
    const glm::vec4 decal = scene.textures[material.decal].texels.at(0, 0);
    EXPECT_NEAR(decal.r, 0.502886, 1e-6); // ((188 / 255 + 0.055) / 1.055)^2.4
    EXPECT_EQ(decal.a, 188 / 255.F);
    EXPECT_EQ(bump_map(scene).texels.at(0, 0), glm::vec4(188 / 255.F));
    EXPECT_EQ(scene.textures.size(), 2U);
}

TEST(textures, of_16_bits_keep_them_and_gray_is_every_color) {
    json gltf = textured_gltf();
    gltf["images"][0] = data_uri(png({0, 1, 256, 65535}, 16));
    gltf["materials"][0] = {
        {"extras", {{"shadowproof", {{"height", {{"index", 0}, {"scale", 3}}}}}}}};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.materials[0].bump, Bump::height_field);
    EXPECT_EQ(scene.materials[0].bump_scale, 3);
    EXPECT_FALSE(scene.materials[0].height_in_space);
    EXPECT_EQ(bump_map(scene).bits, 16);
    EXPECT_EQ(bump_map(scene).texels.at(1, 0), glm::vec4(glm::vec3(1 / 65535.F), 1));
    EXPECT_EQ(bump_map(scene).texels.at(1, 1), glm::vec4(1));
}

TEST(textures, of_heights_are_in_texels_or_in_units_of_space) {
    json gltf = textured_gltf();
    for (const bool in_space : {false, true}) {
        const char* unit = in_space ? "space" : "texel";
        gltf["materials"][0] = {
            {"extras", {{"shadowproof", {{"height", {{"index", 0}, {"unit", unit}}}}}}}};
        EXPECT_EQ(load(gltf).materials[0].height_in_space, in_space);
    }
}

TEST(textures, wrap_as_their_sampler_says_and_repeat_without_one) {
    json gltf = textured_gltf();
    EXPECT_EQ(bump_map(load(gltf)).wrap_s, Wrap::repeat);
    gltf["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    gltf["textures"][0]["sampler"] = 0;
    const Scene scene = load(gltf);
    EXPECT_EQ(bump_map(scene).wrap_s, Wrap::clamp_to_edge);
    EXPECT_EQ(bump_map(scene).wrap_t, Wrap::mirrored_repeat);
    EXPECT_TRUE(says(scene, "nearest texel"));
}

TEST(extras, say_specular_colour_gloss_ambient_and_falloff) {
    json gltf = textured_gltf();
    const Scene plain = load(gltf);
    EXPECT_EQ(plain.materials[0].specular, glm::dvec3(1));
    EXPECT_FALSE(plain.materials[0].gloss_in_alpha);
    EXPECT_EQ(plain.ambient, glm::dvec3(0));
    EXPECT_FALSE(plain.inverse_square);
    EXPECT_EQ(plain.highlight, Highlight{});
    EXPECT_EQ(plain.highlight.exponent(), 8);
    gltf["extras"]["shadowproof"] = {{"ambient", {0.1, 0.2, 0.3}}, {"inverseSquare", true}};
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    gltf["materials"][0]["extras"]["shadowproof"] = {{"specular", {0.4, 0.5, 0.6}},
                                                     {"glossInAlpha", true}};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.materials[0].specular, glm::dvec3(0.4, 0.5, 0.6));
    EXPECT_TRUE(scene.materials[0].gloss_in_alpha);
    EXPECT_EQ(scene.ambient, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_TRUE(scene.inverse_square);
}

TEST(extras, say_how_highlights_are_dimmed_and_their_exponent) {
    json gltf = textured_gltf();
    json& highlight = gltf["extras"]["shadowproof"]["highlight"];
    for (const HighlightShadow shadow : all_highlight_shadows)
        for (int squarings = 0; squarings <= largest_squarings; ++squarings) {
            highlight = {{"shadow", name_of(shadow)}, {"exponent", 1 << squarings}};
            EXPECT_EQ(load(gltf).highlight, (Highlight{shadow, squarings}));
        }
    highlight = {{"exponent", 9}};
    EXPECT_NE(refusal(gltf).find("/extras/shadowproof/highlight/exponent: is 9"),
              std::string::npos);
    highlight = {{"exponent", 256}};
    EXPECT_NE(refusal(gltf).find("/extras/shadowproof/highlight/exponent"), std::string::npos);
    highlight = {{"shadow", "sun"}};
    EXPECT_NE(refusal(gltf).find("/extras/shadowproof/highlight/shadow: is \"sun\""),
              std::string::npos);
}

/// Six faces of 2 x 2 texels, of one gray each.
void give_environment(json& gltf) {
    json& textures = gltf["textures"];
    json faces = json::array();
    for (std::uint16_t i = 0; i < 6; ++i) {
        faces.push_back(textures.size());
        textures.push_back({{"source", gltf["images"].size()}});
        gltf["images"].push_back(data_uri(png(std::vector<std::uint16_t>(4, 40 * i))));
    }
    gltf["extras"]["shadowproof"]["environment"] = {{"faces", faces}};
    gltf["materials"][0]["extras"]["shadowproof"]["reflectance"] = {0.25, 0.5, 1};
}

TEST(extras, say_what_is_reflected_and_how_much_of_it) {
    json gltf = textured_gltf();
    EXPECT_FALSE(load(gltf).environment.has_value());
    EXPECT_EQ(load(gltf).materials[0].reflectance, glm::dvec3(0));
    give_environment(gltf);
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.materials[0].reflectance, glm::dvec3(0.25, 0.5, 1));
    ASSERT_TRUE(scene.environment.has_value());
    for (std::size_t face = 0; face < 6; ++face) {
        const double srgb = 40 * static_cast<double>(face) / 255;
        const double linear =
            srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
        EXPECT_EQ((*scene.environment)[face].width, 2);
        EXPECT_NEAR((*scene.environment)[face].at(1, 0).g, linear, 1e-6);
    }
    EXPECT_EQ(scene.textures.size(), 1U); // the bump map alone
    gltf["materials"][0].erase("normalTexture");
    EXPECT_FALSE(load(gltf).environment.has_value()); // not looked at
}

/// One way to break the textured triangle, and what the message must then hold.
struct Breakage {
    const char* name;
    std::function<void(json&)> apply;
    const char* pointer;
    const char* words;
};

[[maybe_unused]] void PrintTo(const Breakage& breakage, std::ostream* stream) {
    *stream << breakage.name;
}

class MalformedTexture : public testing::TestWithParam<Breakage> {};

TEST_P(MalformedTexture, is_refused_by_its_json_pointer) {
    json gltf = textured_gltf();
    EXPECT_EQ(refusal(gltf), "");
    GetParam().apply(gltf);
    const std::string message = refusal(gltf);
    EXPECT_NE(message.find(std::string("small.gltf") + GetParam().pointer + ": "),
              std::string::npos)
        << message;
    EXPECT_NE(message.find(GetParam().words), std::string::npos) << message;
    EXPECT_NE(message.find("; "), std::string::npos) << message; // a remedy
}

/// A header that promises 34 GB, with nothing behind it.
json vast_png() {
    return data_uri(author::png_of({65536, 65536, 4, 16, {}}));
}

json truncated_png() {
    FileBytes bytes = png({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    bytes.resize(bytes.size() - 30);
    return data_uri(bytes);
}

json& ours(json& gltf) {
    return gltf["materials"][0]["extras"]["shadowproof"];
}

const std::vector<Breakage> breakages{
    {"no_textures", [](json& g) { g.erase("textures"); }, " /materials/0/normalTexture/index",
     "no index into /textures"},
    {"no_images", [](json& g) { g.erase("images"); }, " /textures/0/source",
     "no index into /images"},
    {"no_source", [](json& g) { g["textures"][0].erase("source"); },
     " /materials/0/normalTexture/index", "no PNG or JPEG"},
    {"sampler_out_of_range", [](json& g) { g["textures"][0]["sampler"] = 1; },
     " /textures/0/sampler", "no index into /samplers"},
    {"unknown_wrap",
     [](json& g) {
         g["samplers"] = {{{"wrapT", 10496}}};
         g["textures"][0]["sampler"] = 0;
     },
     " /samplers/0/wrapT", "10496 is no wrap mode"},
    {"neither_uri_nor_view", [](json& g) { g["images"][0] = json::object(); }, " /images/0",
     "neither"},
    {"view_out_of_range",
     [](json& g) {
         g["images"][0] = {{"bufferView", 77}};
     },
     " /images/0/bufferView", "no index into /bufferViews"},
    {"view_beyond_buffer",
     [](json& g) {
         g["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 4000}});
         g["images"][0] = {{"bufferView", g["bufferViews"].size() - 1}};
     },
     " /bufferViews/3", "ends at byte 4000"},
    {"view_of_something_else",
     [](json& g) {
         g["images"][0] = {{"bufferView", 0}};
     },
     " /images/0", "neither a PNG nor a JPEG"},
    {"missing_file",
     [](json& g) {
         g["images"][0] = {{"uri", "nowhere.png"}};
     },
     " /images/0/uri", "does not exist"},
    {"parent_folder",
     [](json& g) {
         g["images"][0] = {{"uri", "../outside.png"}};
     },
     " /images/0/uri", "leaves"},
    {"absolute_path",
     [](json& g) {
         g["images"][0] = {{"uri", "/etc/passwd"}};
     },
     " /images/0/uri", "not relative"},
    {"folder",
     [](json& g) {
         g["images"][0] = {{"uri", "."}};
     },
     " /images/0/uri", ""},
    {"remote",
     [](json& g) {
         g["images"][0] = {{"uri", "https://example.org/a.png"}};
     },
     " /images/0/uri", "not relative"},
    {"bad_base64",
     [](json& g) {
         g["images"][0] = {{"uri", "data:image/png;base64,AA?A"}};
     },
     " /images/0/uri", "base64"},
    {"empty_data",
     [](json& g) {
         g["images"][0] = {{"uri", "data:image/png;base64,"}};
     },
     " /images/0/uri", "empty"},
    {"no_picture",
     [](json& g) {
         g["images"][0] = data_uri({1, 2, 3, 4, 5, 6, 7, 8, 9});
     },
     " /images/0", "neither a PNG nor a JPEG"},
    {"truncated", [](json& g) { g["images"][0] = truncated_png(); }, " /images/0", "damaged"},
    {"vast", [](json& g) { g["images"][0] = vast_png(); }, " /images/0",
     "65536x65536 pixels, more than"},
    {"no_coordinates",
     [](json& g) { g["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0"); },
     " /meshes/0/primitives/0/attributes", "\"TEXCOORD_0\" is missing"},
    {"coordinates_of_another_set",
     [](json& g) { g["materials"][0]["normalTexture"]["texCoord"] = 3; },
     " /meshes/0/primitives/0/attributes", "\"TEXCOORD_3\" is missing"},
    {"coordinates_of_wrong_type",
     [](json& g) { g["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 0; },
     " /meshes/0/primitives/0/attributes/TEXCOORD_0", "VEC3"},
    {"too_few_coordinates", [](json& g) { g["accessors"][2]["count"] = 2; },
     " /meshes/0/primitives/0/attributes/TEXCOORD_0", "2 elements for 3 vertices"},
    {"height_beside_normals",
     [](json& g) {
         ours(g)["height"] = {{"index", 0}};
     },
     " /materials/0/extras/shadowproof/height", "second bump map"},
    {"height_of_no_texture",
     [](json& g) {
         g["materials"][0].erase("normalTexture");
         ours(g)["height"] = {{"index", 9}};
     },
     " /materials/0/extras/shadowproof/height/index", "no index into /textures"},
    {"height_of_no_unit",
     [](json& g) {
         g["materials"][0].erase("normalTexture");
         ours(g)["height"] = {{"index", 0}, {"unit", "metre"}};
     },
     " /materials/0/extras/shadowproof/height/unit", "choose texel, or space"},
    {"height_of_a_number_as_unit",
     [](json& g) {
         g["materials"][0].erase("normalTexture");
         ours(g)["height"] = {{"index", 0}, {"unit", 1}};
     },
     " /materials/0/extras/shadowproof/height/unit", ""},
    {"gloss_without_decal", [](json& g) { ours(g)["glossInAlpha"] = true; },
     " /materials/0/extras/shadowproof/glossInAlpha", "no texture"},
    {"specular_too_short",
     [](json& g) {
         ours(g)["specular"] = {1, 2};
     },
     " /materials/0/extras/shadowproof/specular", "3"},
    {"negative_specular",
     [](json& g) {
         ours(g)["specular"] = {1, -2, 3};
     },
     " /materials/0/extras/shadowproof/specular/1", "negative"},
    {"ambient_is_text", [](json& g) { g["extras"]["shadowproof"]["ambient"] = "dim"; },
     " /extras/shadowproof/ambient", "not an array"},
    {"environment_without_faces",
     [](json& g) { g["extras"]["shadowproof"]["environment"] = json::object(); },
     " /extras/shadowproof/environment", "\"faces\" is missing"},
    {"five_faces",
     [](json& g) {
         give_environment(g);
         g["extras"]["shadowproof"]["environment"]["faces"].erase(5);
     },
     " /extras/shadowproof/environment/faces", "5 elements, not 6"},
    {"face_of_no_texture",
     [](json& g) {
         give_environment(g);
         g["extras"]["shadowproof"]["environment"]["faces"][3] = 77;
     },
     " /extras/shadowproof/environment/faces/3", "no index into /textures"},
    {"face_that_is_not_square",
     [](json& g) {
         give_environment(g);
         g["images"].back() = data_uri(author::png_of({2, 1, 1, 8, {0, 1}}));
     },
     " /extras/shadowproof/environment/faces/5", "2x1 texels"},
    {"face_of_another_size",
     [](json& g) {
         give_environment(g);
         g["images"].back() = data_uri(author::png_of({1, 1, 1, 8, {0}}));
     },
     " /extras/shadowproof/environment/faces/5", "1x1 texels"},
    {"reflectance_of_nothing",
     [](json& g) {
         ours(g)["reflectance"] = {1, 1, 1};
     },
     " /materials/0/extras/shadowproof/reflectance", "environment that the file does not have"},
    {"negative_reflectance",
     [](json& g) {
         give_environment(g);
         ours(g)["reflectance"] = {1, 1, -1};
     },
     " /materials/0/extras/shadowproof/reflectance/2", "negative"},
    {"scale_is_text", [](json& g) { g["materials"][0]["normalTexture"]["scale"] = "2"; },
     " /materials/0/normalTexture/scale", "not a number"},
};

INSTANTIATE_TEST_SUITE_P(Textures, MalformedTexture, testing::ValuesIn(breakages),
                         [](const testing::TestParamInfo<Breakage>& breakage) {
                             return std::string(breakage.param.name);
                         });

} // namespace
} // namespace shadowproof::test
