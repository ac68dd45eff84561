#include "tests/scenes/small_gltf.h"

#include "scenes/bundled/author/png.h"
#include "scenes/error.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace shadowproof::test {

using nlohmann::json;

Folder::Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "shadowproof-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
}

Folder::~Folder() {
    std::filesystem::remove_all(path_);
}

void write_bytes(const std::filesystem::path& file, const FileBytes& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

FileBytes bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string base64(const FileBytes& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    unsigned held = 0;
    int bits = 0;
    for (const std::uint8_t byte : bytes) {
        held = (held << 8U | byte) & 0xffffU;
        for (bits += 8; bits >= 6; bits -= 6)
            text += digits[held >> static_cast<unsigned>(bits - 6) & 63U];
    }
    if (bits > 0) text += digits[held << static_cast<unsigned>(6 - bits) & 63U];
    while (text.size() % 4 != 0) text += '=';
    return text;
}

std::size_t add_accessor(json& gltf, const FileBytes& bytes, int component_type, std::size_t count,
                         const std::string& type) {
    gltf["buffers"].push_back({{"byteLength", bytes.size()},
                               {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    gltf["bufferViews"].push_back(
        {{"buffer", gltf["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                                 {"componentType", component_type},
                                 {"count", count},
                                 {"type", type}});
    return gltf["accessors"].size() - 1;
}

std::size_t add_positions(json& gltf, const std::vector<glm::vec3>& positions) {
    FileBytes bytes;
    for (const glm::vec3& position : positions)
        for (int k = 0; k < 3; ++k) put(bytes, position[k]);
    return add_accessor(gltf, bytes, 5126, positions.size(), "VEC3");
}

json triangle_gltf() {
    json gltf = {{"asset", {{"version", "2.0"}}}, {"scene", 0},
                 {"scenes", {{{"nodes", {0}}}}},  {"nodes", {{{"mesh", 0}}}},
                 {"buffers", json::array()},      {"bufferViews", json::array()},
                 {"accessors", json::array()}};
    add_positions(gltf, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    FileBytes indices;
    for (std::uint16_t index = 0; index < 3; ++index) put(indices, index);
    add_accessor(gltf, indices, 5123, 3, "SCALAR");
    const json primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}};
    gltf["meshes"] = json::array({{{"primitives", json::array({primitive})}}});
    return gltf;
}

json textured_gltf() {
    json gltf = triangle_gltf();
    FileBytes coordinates;
    for (const float value : {0.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F}) put(coordinates, value);
    gltf["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        add_accessor(gltf, coordinates, 5126, 3, "VEC2");
    author::Raster flat{2, 2, 3, 8, {}};
    for (int i = 0; i < 4; ++i)
        for (const unsigned value : {128U, 128U, 255U})
            flat.values.push_back(static_cast<std::uint16_t>(value));
    gltf["images"] = {{{"uri", "data:image/png;base64," + base64(png_of(flat))}}};
    gltf["textures"] = {{{"source", 0}}};
    gltf["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    gltf["meshes"][0]["primitives"][0]["material"] = 0;
    return gltf;
}

FileBytes glb_of(const json& gltf, const FileBytes& binary) {
    std::string text = gltf.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    FileBytes padded = binary;
    padded.resize((padded.size() + 3) / 4 * 4, 0);
    FileBytes glb;
    put(glb, 0x46546C67U);
    put(glb, 2U);
    put(glb, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + padded.size()));
    put(glb, static_cast<std::uint32_t>(text.size()));
    put(glb, 0x4E4F534AU);
    glb.insert(glb.end(), text.begin(), text.end());
    put(glb, static_cast<std::uint32_t>(padded.size()));
    put(glb, 0x004E4942U);
    glb.insert(glb.end(), padded.begin(), padded.end());
    return glb;
}

namespace {

Scene load_from(const Folder& folder, const json& gltf, const SceneRequest& request) {
    const std::string text = gltf.dump();
    write_bytes(folder.path() / "small.gltf", FileBytes(text.begin(), text.end()));
    return load_gltf(folder.path() / "small.gltf", request);
}

} // namespace

Scene load(const json& gltf, const SceneRequest& request) {
    const Folder folder;
    return load_from(folder, gltf, request);
}

std::string refusal_of_file(const std::filesystem::path& file, const SceneRequest& request) {
    try {
        load_gltf(file, request);
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

std::string refusal(const json& gltf, const SceneRequest& request) {
    try {
        load(gltf, request);
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

bool says(const Scene& scene, const std::string& words) {
    return std::any_of(scene.notes.begin(), scene.notes.end(), [&](const std::string& note) {
        return note.find(words) != std::string::npos;
    });
}

} // namespace shadowproof::test
