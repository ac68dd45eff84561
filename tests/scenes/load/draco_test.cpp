#include "tests/scenes/draco_encoder.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace shadowproof::test {
namespace {

using nlohmann::json;

constexpr const char* extension = "KHR_draco_mesh_compression";

/// A square of n x n vertices, bent, as Draco compresses it. Attribute 0 holds its positions.
struct Bent {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

Bent bent(std::uint32_t n) {
    Bent square;
    for (std::uint32_t i = 0; i < n * n; ++i) {
        const auto x = static_cast<float>(i % n);
        const auto y = static_cast<float>(i / n);
        square.positions.emplace_back(x, y, 0.01F * x * y);
    }
    for (std::uint32_t y = 0; y + 1 < n; ++y)
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            const std::uint32_t a = n * y + x;
            square.triangles.emplace_back(a, a + 1, a + n);
            square.triangles.emplace_back(a + 1, a + n + 1, a + n);
        }
    return square;
}

FileBytes compressed(const Bent& source, bool edgebreaker, int position_bits) {
    return draco_of(source.positions, source.triangles, edgebreaker, position_bits);
}

/// A file with one primitive, whose positions and indices are in `stream`.
json draco_gltf(const FileBytes& stream, std::size_t vertices, std::size_t triangles) {
    json gltf = triangle_gltf();
    gltf["buffers"] = {{{"byteLength", stream.size()},
                        {"uri", "data:application/octet-stream;base64," + base64(stream)}}};
    gltf["bufferViews"] = {{{"buffer", 0}, {"byteLength", stream.size()}}};
    gltf["accessors"] = {{{"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}},
                         {{"componentType", 5125}, {"count", 3 * triangles}, {"type", "SCALAR"}}};
    gltf["meshes"][0]["primitives"][0]["extensions"][extension] = {
        {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    gltf["extensionsUsed"] = gltf["extensionsRequired"] = {extension};
    return gltf;
}

/// Corners of all triangles, as a set: Draco changes the order of both.
std::vector<std::array<float, 9>> soup(const std::vector<glm::vec3>& positions,
                                       const std::vector<glm::uvec3>& triangles) {
    std::vector<std::array<float, 9>> result;
    for (const glm::uvec3& t : triangles) {
        std::array<glm::vec3, 3> corners{positions[t.x], positions[t.y], positions[t.z]};
        const auto before = [](const glm::vec3& a, const glm::vec3& b) {
            return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
        };
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), before),
                    corners.end());
        result.push_back({corners[0].x, corners[0].y, corners[0].z, corners[1].x, corners[1].y,
                          corners[1].z, corners[2].x, corners[2].y, corners[2].z});
    }
    std::sort(result.begin(), result.end());
    return result;
}

json sound_gltf() {
    const Bent source = bent(4);
    return draco_gltf(compressed(source, true, 0), source.positions.size(),
                      source.triangles.size());
}

TEST(draco, a_compressed_primitive_has_the_triangles_that_were_compressed) {
    const Bent source = bent(12);
    for (const bool edgebreaker : {false, true}) {
        const Scene scene = load(draco_gltf(compressed(source, edgebreaker, 0),
                                            source.positions.size(), source.triangles.size()));
        EXPECT_EQ(soup(scene.positions, scene.triangles), soup(source.positions, source.triangles));
        EXPECT_FALSE(says(scene, extension));
    }
    // Not because it would accept anything: with few bits the positions are others.
    const Scene coarse = load(
        draco_gltf(compressed(source, true, 8), source.positions.size(), source.triangles.size()));
    EXPECT_NE(soup(coarse.positions, coarse.triangles), soup(source.positions, source.triangles));
}

TEST(draco, two_primitives_may_share_a_compressed_mesh) {
    json gltf = sound_gltf();
    gltf["meshes"][0]["primitives"].push_back(gltf["meshes"][0]["primitives"][0]);
    EXPECT_EQ(load(gltf).triangles.size(), 2 * load(sound_gltf()).triangles.size());
    gltf["meshes"][0]["primitives"][1]["extensions"][extension]["attributes"]["POSITION"] = 1;
    EXPECT_NE(refusal(gltf).find("/meshes/0/primitives/1/attributes/POSITION: names accessor 0, "
                                 "which is decompressed from elsewhere, too"),
              std::string::npos);
}

TEST(draco, what_does_not_match_the_accessors_is_refused_by_name) {
    const auto words = [](const char* pointer, const json& value) {
        json gltf = sound_gltf();
        gltf[json::json_pointer(pointer)] = value;
        return refusal(gltf);
    };
    EXPECT_NE(words("/accessors/0/count", 15)
                  .find("/accessors/0: has a count of 15, but the compressed mesh has 16 vertices"),
              std::string::npos);
    EXPECT_NE(words("/accessors/1/count", 51)
                  .find("/accessors/1: has a count of 51, but the compressed mesh has 54 indices"),
              std::string::npos);
    EXPECT_NE(words("/accessors/1/componentType", 5126).find("/accessors/1: holds indices, but"),
              std::string::npos);
    const std::string object = std::string("/meshes/0/primitives/0/extensions/") + extension;
    EXPECT_NE(words((object + "/attributes/POSITION").c_str(), 7)
                  .find("/accessors/0: is attribute 7 of a compressed mesh that has no such one"),
              std::string::npos);
    EXPECT_NE(words((object + "/bufferView").c_str(), 3).find("3 is no index into /bufferViews"),
              std::string::npos);
    EXPECT_NE(words("/meshes/0/primitives/0/mode", 5).find("/mode: is not 4"), std::string::npos);
    EXPECT_NE(words("/bufferViews/0/byteLength", 20).find("is refused by Draco"),
              std::string::npos);
    EXPECT_NE(words("/bufferViews/0/byteLength", 20000).find("/bufferViews/0: ends at byte 20000"),
              std::string::npos);
    json gltf = sound_gltf();
    gltf["meshes"][0]["primitives"][0].erase("indices");
    EXPECT_NE(refusal(gltf).find("/meshes/0/primitives/0: is compressed by Draco and has no"),
              std::string::npos);
    gltf = sound_gltf();
    gltf["accessors"][0]["type"] = "VEC2";
    EXPECT_NE(refusal(gltf).find("/accessors/0: has 2 components, but the compressed mesh has 3"),
              std::string::npos);
}

TEST(draco, counts_that_do_not_fit_the_budget_are_refused_before_anything_is_decoded) {
    json gltf = sound_gltf();
    gltf["accessors"][1]["count"] = 30'000'000;
    SceneRequest request;
    request.memory.bytes = 1'000'000'000;
    EXPECT_NE(refusal(gltf, request).find("decoding it"), std::string::npos);
    gltf["accessors"][1]["count"] = 600'000'000;
    EXPECT_NE(refusal(gltf).find("brings what is compressed above"), std::string::npos);
}

TEST(draco, a_stream_of_more_than_its_accessors_account_for_is_refused_while_it_is_decoded) {
    const Bent source = bent(700);
    const FileBytes stream = compressed(source, true, 12);
    EXPECT_EQ(
        load(draco_gltf(stream, source.positions.size(), source.triangles.size())).triangles.size(),
        source.triangles.size());
#if !defined(                                                                                      \
    __SANITIZE_ADDRESS__) // under which the decoder's addresses have no limit (isolated.cpp)
    EXPECT_NE(refusal(draco_gltf(stream, 3, 1)).find("takes more memory to decode"),
              std::string::npos);
#endif
}

TEST(draco, a_damaged_stream_loads_or_is_refused) {
    const Bent source = bent(8);
    const unsigned seed = 20261125;
    std::mt19937 random(seed);
    int refused = 0;
    int loaded = 0;
    for (const bool edgebreaker : {false, true}) {
        const FileBytes whole = compressed(source, edgebreaker, 10);
        for (int i = 0; i < 400; ++i) {
            FileBytes stream = whole;
            for (std::size_t n = 1 + random() % 3; n > 0; --n)
                stream[random() % stream.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
            const std::string words =
                refusal(draco_gltf(stream, source.positions.size(), source.triangles.size()));
            ++(words.empty() ? loaded : refused);
            EXPECT_TRUE(words.empty() || words.find(".gltf /") != std::string::npos) << words;
        }
    }
    EXPECT_GT(refused, 100) << "seed " << seed;
    EXPECT_GT(loaded, 10) << "seed " << seed;
}

} // namespace
} // namespace shadowproof::test
