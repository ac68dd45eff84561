// Small glTF assets made in the test itself, and the folder they are written to.
#pragma once

#include "scenes/load/gltf/gltf.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shadowproof::test {

/// A folder that is removed with everything in it.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

using FileBytes = std::vector<std::uint8_t>;

void write_bytes(const std::filesystem::path& file, const FileBytes& bytes);
FileBytes bytes_of(const std::filesystem::path& file);

/// Appends a value's bytes as they lie in memory.
template <class T>
void put(FileBytes& bytes, T value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
}

std::string base64(const FileBytes& bytes);

/// One triangle (0,0,0) (1,0,0) (0,1,0) in one node; accessor 0 its positions, 1 its indices
/// (unsigned short), buffer views likewise, buffer 0 embedded. No camera and no light.
nlohmann::json triangle_gltf();

/// Appends a buffer, a view and an accessor over `bytes`. The accessor's index.
std::size_t add_accessor(nlohmann::json& gltf, const FileBytes& bytes, int component_type,
                         std::size_t count, const std::string& type);
std::size_t add_positions(nlohmann::json& gltf, const std::vector<glm::vec3>& positions);

/// The triangle with a normal map (a PNG in a data URI of 2 x 2 texels: 0.5 0.5 1 all over, as
/// near as bytes come to it) and texture coordinates (0, 1) (1, 1) (0, 0): upright. Accessor 2.
nlohmann::json textured_gltf();

/// A GLB of `gltf` whose buffer 0 is `binary`.
FileBytes glb_of(const nlohmann::json& gltf, const FileBytes& binary);

Scene load(const nlohmann::json& gltf, const SceneRequest& request = {});
/// The message of the Error that loading throws; empty where it does not.
std::string refusal(const nlohmann::json& gltf, const SceneRequest& request = {});
std::string refusal_of_file(const std::filesystem::path& file, const SceneRequest& request = {});

/// Whether some note contains `words`.
bool says(const Scene& scene, const std::string& words);

} // namespace shadowproof::test
