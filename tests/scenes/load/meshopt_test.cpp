#include "scenes/error.h"
#include "scenes/load/compressed/meshopt.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>

namespace shadowproof::test {
namespace {

using nlohmann::json;

const std::string file_name = "small.gltf";
const Place place = Place(file_name) / "extension";

/// A stream of meshoptimizer's encoder and what its own decoder makes of it (meshopt_vectors.mjs).
struct Vector {
    std::string mode;
    std::string filter;
    MeshoptLayout layout;
    FileBytes stream;
    FileBytes decoded;
};

FileBytes from_base64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    FileBytes bytes;
    unsigned held = 0;
    int bits = 0;
    for (const char c : text.substr(0, text.find('='))) {
        held = held << 6U | static_cast<unsigned>(digits.find(c));
        if ((bits += 6) < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<std::uint8_t>(held >> static_cast<unsigned>(bits)));
    }
    return bytes;
}

MeshoptFilter filter_of(const std::string& name) {
    if (name == "OCTAHEDRAL") return MeshoptFilter::octahedral;
    if (name == "QUATERNION") return MeshoptFilter::quaternion;
    if (name == "EXPONENTIAL") return MeshoptFilter::exponential;
    return name == "COLOR" ? MeshoptFilter::color : MeshoptFilter::none;
}

std::vector<Vector> read_vectors() {
    std::ifstream stream(SHADOWPROOF_TEST_SCENES "/load/meshopt_vectors.json");
    std::vector<Vector> vectors;
    for (const json& item : json::parse(stream)) {
        const std::string mode = item["mode"];
        vectors.push_back({mode,
                           item["filter"],
                           {mode == "ATTRIBUTES"  ? MeshoptMode::attributes
                            : mode == "TRIANGLES" ? MeshoptMode::triangles
                                                  : MeshoptMode::indices,
                            filter_of(item["filter"]), item["count"], item["stride"]},
                           from_base64(item["stream"]),
                           from_base64(item["decoded"])});
    }
    return vectors;
}

FileBytes decoded(const Vector& vector, const FileBytes& stream) {
    FileBytes target(vector.layout.count * vector.layout.stride);
    decode_meshopt(place, vector.layout, stream, target);
    return target;
}

std::string fault(const Vector& vector, const FileBytes& stream) {
    try {
        decoded(vector, stream);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// The largest difference between two arrays of integers of one or two bytes. Decoders may round
/// differently where a filter computes in floats.
int largest_difference(const FileBytes& a, const FileBytes& b, std::size_t bytes) {
    int largest = 0;
    for (std::size_t i = 0; i < a.size(); i += bytes) {
        std::int16_t x = static_cast<std::int8_t>(a[i]);
        std::int16_t y = static_cast<std::int8_t>(b[i]);
        if (bytes == 2) {
            std::memcpy(&x, a.data() + i, 2);
            std::memcpy(&y, b.data() + i, 2);
        }
        largest = std::max(largest, std::abs(x - y));
    }
    return largest;
}

TEST(meshopt, streams_of_every_mode_and_version_decode_to_the_bytes_that_were_encoded) {
    int tried = 0;
    for (const Vector& vector : read_vectors()) {
        const bool is_exact = vector.filter == "NONE" || vector.filter == "EXPONENTIAL";
        if (!is_exact) continue;
        ++tried;
        EXPECT_EQ(decoded(vector, vector.stream), vector.decoded)
            << vector.mode << ' ' << vector.filter << ' ' << vector.layout.count << " of "
            << vector.layout.stride;
    }
    EXPECT_GE(tried, 30);
}

TEST(meshopt, vectors_turns_and_colors_are_unfiltered_to_the_nearest_number_but_one) {
    int tried = 0;
    for (const Vector& vector : read_vectors()) {
        if (vector.filter == "NONE" || vector.filter == "EXPONENTIAL") continue;
        ++tried;
        const std::size_t bytes = vector.layout.stride / 4;
        EXPECT_LE(largest_difference(decoded(vector, vector.stream), vector.decoded, bytes), 1)
            << vector.filter;
        // Without the filter they are something else.
        Vector plain = vector;
        plain.layout.filter = MeshoptFilter::none;
        EXPECT_GT(largest_difference(decoded(plain, vector.stream), vector.decoded, bytes), 1);
    }
    EXPECT_GE(tried, 6);
}

TEST(meshopt, a_stream_that_is_cut_short_or_too_long_is_refused) {
    for (const Vector& vector : read_vectors()) {
        for (std::size_t size = 0; size < vector.stream.size(); ++size) {
            const FileBytes cut(vector.stream.begin(),
                                vector.stream.begin() + static_cast<std::ptrdiff_t>(size));
            EXPECT_NE(fault(vector, cut), "") << vector.mode << ", " << size << " bytes";
        }
        FileBytes longer = vector.stream;
        longer.insert(longer.begin() + 1, 0);
        EXPECT_NE(fault(vector, longer), "") << vector.mode;
    }
}

TEST(meshopt, a_damaged_stream_is_refused_or_decoded_to_something_else) {
    const unsigned seed = 20261125;
    std::mt19937 random(seed);
    int refused = 0;
    int different = 0;
    for (const Vector& vector : read_vectors())
        for (int i = 0; i < 400; ++i) {
            FileBytes stream = vector.stream;
            for (std::size_t n = 1 + random() % 3; n > 0; --n)
                stream[random() % stream.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
            try {
                different += decoded(vector, stream) != vector.decoded ? 1 : 0;
            } catch (const Error& error) {
                ++refused;
                EXPECT_NE(std::string(error.what()).find("small.gltf /extension"),
                          std::string::npos);
            }
        }
    EXPECT_GT(refused, 1000) << "seed " << seed;
    EXPECT_GT(different, 1000) << "seed " << seed;
}

TEST(meshopt, layouts_that_the_specification_forbids_are_refused_by_name) {
    const auto words = [](const MeshoptLayout& layout) -> std::string {
        try {
            check_meshopt(place, layout);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    };
    using enum MeshoptMode;
    EXPECT_EQ(words({attributes, MeshoptFilter::none, 5, 12}), "");
    EXPECT_NE(words({attributes, MeshoptFilter::none, 5, 6}).find("/byteStride: 6"),
              std::string::npos);
    EXPECT_NE(words({attributes, MeshoptFilter::quaternion, 5, 4}).find("/byteStride: 4"),
              std::string::npos);
    EXPECT_NE(words({triangles, MeshoptFilter::none, 4, 2}).find("/count: 4"), std::string::npos);
    EXPECT_NE(words({indices, MeshoptFilter::none, 4, 3}).find("/byteStride: 3"),
              std::string::npos);
    EXPECT_NE(words({indices, MeshoptFilter::color, 4, 4}).find("/filter: filters"),
              std::string::npos);
}

/// The triangle, with its positions and indices compressed. The buffer that they were in has no
/// bytes any more.
json compressed_triangle(const char* extension) {
    json gltf = triangle_gltf();
    const FileBytes indices = {0xe1, 0xf0, 0,    0x76, 0x87, 0x56, 0x67, 0x78, 0xa9,
                               0x86, 0x65, 0x89, 0x68, 0x98, 1,    0x69, 0,    0};
    // One element after the other, uncompressed: a header, three bytes for each of twelve.
    FileBytes positions{0xa1, 0xff, 0xff, 0xff};
    const float values[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::uint8_t bytes[3][12];
    std::memcpy(bytes, values, sizeof bytes);
    for (int k = 0; k < 12; ++k)
        for (int i = 0; i < 3; ++i) {
            const auto delta =
                static_cast<std::uint8_t>(bytes[i][k] - (i > 0 ? bytes[i - 1][k] : 0));
            positions.push_back(
                static_cast<std::uint8_t>(delta << 1U ^ (delta & 0x80U ? 0xffU : 0U)));
        }
    positions.resize(positions.size() + 24, 0);
    const std::size_t streams = gltf["buffers"].size();
    for (const FileBytes& stream : {positions, indices})
        gltf["buffers"].push_back(
            {{"byteLength", stream.size()},
             {"uri", "data:application/octet-stream;base64," + base64(stream)}});
    gltf["buffers"][0].erase("uri");
    gltf["buffers"][1] = {{"byteLength", 1U << 29U},
                          {"uri", "missing.bin"},
                          {"extensions", {{extension, {{"fallback", true}}}}}};
    gltf["bufferViews"][0]["extensions"][extension] = {{"buffer", streams},
                                                       {"byteLength", positions.size()},
                                                       {"byteStride", 12},
                                                       {"mode", "ATTRIBUTES"},
                                                       {"count", 3}};
    gltf["bufferViews"][1]["extensions"][extension] = {
        {"buffer", streams + 1}, {"byteLength", indices.size()},
        {"byteStride", 2},       {"mode", "TRIANGLES"},
        {"filter", "NONE"},      {"count", 3}};
    gltf["extensionsUsed"] = gltf["extensionsRequired"] = {extension};
    return gltf;
}

TEST(meshopt, a_compressed_buffer_view_is_read_like_any_other) {
    for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        const Scene scene = load(compressed_triangle(extension));
        const Scene plain = load(triangle_gltf());
        EXPECT_EQ(scene.positions, plain.positions);
        EXPECT_EQ(scene.triangles, plain.triangles);
        EXPECT_FALSE(says(scene, extension));
    }
}

TEST(meshopt, what_a_compressed_buffer_view_says_is_checked_before_it_is_decoded) {
    const json sound = compressed_triangle("EXT_meshopt_compression");
    const auto words = [&](const char* pointer, const json& value) {
        json gltf = sound;
        gltf[json::json_pointer(pointer)] = value;
        return refusal(gltf);
    };
    const std::string of_positions = "/bufferViews/0/extensions/EXT_meshopt_compression";
    const auto at = [&](const char* member) { return of_positions + '/' + member; };
    EXPECT_NE(words(at("mode").c_str(), "OTHER").find("/mode: \"OTHER\" is no mode"),
              std::string::npos);
    EXPECT_NE(words(at("filter").c_str(), "OTHER").find("/filter: \"OTHER\" is no filter"),
              std::string::npos);
    EXPECT_NE(words(at("buffer").c_str(), 9).find("/buffer: 9 is no index"), std::string::npos);
    EXPECT_NE(words(at("buffer").c_str(), 1).find("/bufferViews/0: reads a fallback buffer"),
              std::string::npos);
    EXPECT_NE(words(at("byteOffset").c_str(), 1).find("ends at byte"), std::string::npos);
    EXPECT_NE(words(at("byteLength").c_str(), 20).find("ends too early"), std::string::npos);
    EXPECT_NE(words(at("count").c_str(), 4).find("/bufferViews/0/byteLength: is 36, but 4"),
              std::string::npos);
    json plain = sound;
    plain["bufferViews"][1].erase("extensions");
    plain["bufferViews"][1]["buffer"] = 1;
    EXPECT_NE(refusal(plain).find("/bufferViews/1: reads a fallback buffer"), std::string::npos);
}

TEST(meshopt, elements_that_do_not_fit_the_budget_are_refused_before_they_are_decoded) {
    json gltf = compressed_triangle("EXT_meshopt_compression");
    const std::uint64_t count = 80'000'000;
    gltf["bufferViews"][0]["byteLength"] = 12 * count;
    gltf["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = count;
    SceneRequest request;
    request.memory.bytes = 500'000'000;
    EXPECT_NE(refusal(gltf, request).find("its elements"), std::string::npos)
        << refusal(gltf, request);
    gltf["bufferViews"][0]["byteLength"] = 200 * count;
    EXPECT_NE(refusal(gltf).find("is not an integer from 1 to"), std::string::npos);
}

} // namespace
} // namespace shadowproof::test
