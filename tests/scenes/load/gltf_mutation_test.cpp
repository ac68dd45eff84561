#include "scenes/error.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <random>

namespace shadowproof::test {
namespace {

using nlohmann::json;

constexpr int mutations = 3000;

/// A few bytes of the file set, dropped, doubled or swapped for a number that hurts.
FileBytes mutated(FileBytes bytes, std::mt19937& random) {
    const auto below = [&](std::size_t end) { return random() % end; };
    const std::vector<std::string> nasty{"-1", "4294967295",           "1e308", "null", "[]",
                                         "{}", "99999999999999999999", "0.5",   "\"\"", "true"};
    for (std::size_t n = 1 + below(4); n > 0 && !bytes.empty(); --n) {
        const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
        switch (below(5)) {
        case 0:
            *place = static_cast<std::uint8_t>(random());
            break;
        case 1:
            *place ^= static_cast<std::uint8_t>(1U << below(8));
            break;
        case 2:
            bytes.erase(place);
            break;
        case 3:
            bytes.insert(place, *place);
            break;
        default: {
            // The next number in the text, if there is one.
            auto digit =
                std::find_if(place, bytes.end(), [](int c) { return c >= '0' && c <= '9'; });
            if (digit == bytes.end()) break;
            auto end = std::find_if(digit, bytes.end(), [](int c) { return c < '0' || c > '9'; });
            const std::string& text = nasty[below(nasty.size())];
            digit = bytes.erase(digit, end);
            bytes.insert(digit, text.begin(), text.end());
        }
        }
    }
    return bytes;
}

/// Camera, light, skin, morph, animation, textures and bump maps, so that all code is within reach.
json everything() {
    json gltf = textured_gltf();
    gltf["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9729}}});
    gltf["textures"].push_back({{"source", 0}, {"sampler", 0}});
    const json decal = {{"baseColorTexture", {{"index", 1}, {"texCoord", 0}}},
                        {"baseColorFactor", {1, 0.5, 0.25, 1}}};
    gltf["materials"][0]["pbrMetallicRoughness"] = decal;
    gltf["materials"].push_back({{"pbrMetallicRoughness", decal},
                                 {"extras",
                                  {{"shadowproof",
                                    {{"height", {{"index", 1}, {"scale", 2}, {"unit", "space"}}},
                                     {"glossInAlpha", true},
                                     {"specular", {1, 1, 0}}}}}}});
    gltf["extras"]["shadowproof"] = {{"ambient", {0, 0, 1}},
                                     {"inverseSquare", true},
                                     {"highlight", {{"shadow", "both"}, {"exponent", 16}}},
                                     {"environment", {{"faces", {0, 0, 0, 1, 1, 1}}}}};
    gltf["materials"][0]["extras"]["shadowproof"]["reflectance"] = {1, 0, 1};
    json second = gltf["meshes"][0]["primitives"][0];
    second["material"] = 1;
    second["attributes"]["NORMAL"] = 0;
    gltf["meshes"].push_back({{"primitives", json::array({second})}});
    json& primitive = gltf["meshes"][0]["primitives"][0];
    const std::size_t joints = add_accessor(gltf, FileBytes(12, 0), 5121, 3, "VEC4");
    FileBytes weights;
    for (int i = 0; i < 12; ++i) put(weights, i % 4 == 0 ? 1.F : 0.F);
    primitive["attributes"]["JOINTS_0"] = joints;
    primitive["attributes"]["WEIGHTS_0"] = add_accessor(gltf, weights, 5126, 3, "VEC4");
    primitive["targets"] = json::array({{{"POSITION", 0}}});
    gltf["skins"] = json::array({{{"joints", {1}}}});
    gltf["nodes"][0]["skin"] = 0;
    gltf["nodes"].push_back({{"camera", 0}, {"translation", {0.25, 0.25, 3}}});
    gltf["nodes"].push_back(
        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {1, 2, 3}}});
    gltf["nodes"].push_back({{"mesh", 1}, {"children", {1, 2}}});
    gltf["scenes"][0]["nodes"] = {0, 3};
    json& extensions = gltf["nodes"].back()["extensions"];
    extensions["KHR_node_visibility"]["visible"] = true;
    extensions["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        add_positions(gltf, {{0, 0, 0}, {2, 0, 0}});
    gltf["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0}}, {"rotation", 1}, {"scale", {2, 2}}, {"texCoord", 0}};
    gltf["cameras"] = json::array(
        {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 9}}}}});
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "point"}}});
    FileBytes times;
    for (const float time : {0.F, 1.F}) put(times, time);
    const json sampler = {{"input", add_accessor(gltf, times, 5126, 2, "SCALAR")},
                          {"output", add_positions(gltf, {{0, 0, 0}, {1, 1, 1}})}};
    const json channel = {{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}};
    gltf["animations"] =
        json::array({{{"samplers", json::array({sampler})}, {"channels", json::array({channel})}}});
    return gltf;
}

/// Loads or throws Error; anything else (another exception, a signal, a sanitizer) fails the test.
void try_mutations(const FileBytes& whole, const char* name, unsigned seed) {
    std::mt19937 random(seed);
    const Folder folder;
    const auto file = folder.path() / name;
    write_bytes(file, whole);
    ASSERT_EQ(refusal_of_file(file), "");
    int loaded = 0;
    for (int i = 0; i < mutations; ++i) {
        write_bytes(file, mutated(whole, random));
        ASSERT_NO_THROW(loaded += refusal_of_file(file).empty() ? 1 : 0)
            << "seed " << seed << ", mutation " << i;
    }
    EXPECT_GT(loaded, 0);
    EXPECT_LT(loaded, mutations);
}

TEST(mutation, a_damaged_gltf_loads_or_is_refused) {
    const std::string text = everything().dump();
    try_mutations(FileBytes(text.begin(), text.end()), "mutated.gltf", 20010718);
}

TEST(mutation, a_damaged_glb_loads_or_is_refused) {
    json gltf = everything();
    gltf["buffers"][0].erase("uri");
    FileBytes binary;
    for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(binary, value);
    try_mutations(glb_of(gltf, binary), "mutated.glb", 20020109);
}

} // namespace
} // namespace shadowproof::test
