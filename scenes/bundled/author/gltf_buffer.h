// The buffer of a .gltf file as it grows: bytes, the views into them, and the accessors of the
// views.
#pragma once

#include "scenes/bundled/author/gltf_writer.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof::author {

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
inline constexpr int component_float = 5126;
inline constexpr int target_vertices = 34962;

inline Json array(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}
inline Json array(const glm::dquat& q) {
    return Json::array({q.x, q.y, q.z, q.w});
}

struct Buffer {
    std::vector<std::uint8_t> bytes;
    Json views = Json::array();
    Json accessors = Json::array();

    void append(std::uint32_t word, unsigned size) {
        for (unsigned i = 0; i < size; ++i)
            bytes.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
    }

    /// Index of a new view from `offset` to the end, the buffer then padded to whole words. Key
    /// frames have no target.
    std::size_t close_view(std::size_t offset, std::optional<int> target) {
        Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size() - offset}};
        if (target) view["target"] = *target;
        views.push_back(view);
        while (bytes.size() % 4 != 0) bytes.push_back(0);
        return views.size() - 1;
    }
};

/// Bytes as text (RFC 4648).
std::string base64(const std::vector<std::uint8_t>& bytes);

// Each of the following appends one accessor, and returns its index.

/// With bounds, rounded to float.
std::size_t add_positions(Buffer& buffer, const std::vector<glm::dvec3>& vertices,
                          std::optional<int> target = target_vertices);

/// Float vectors without bounds: normals, tangents, texture coordinates.
template <class Vector>
std::size_t add_vectors(Buffer& buffer, const std::vector<Vector>& vectors) {
    const std::size_t offset = buffer.bytes.size();
    for (const Vector& vector : vectors)
        for (int k = 0; k < vector.length(); ++k)
            buffer.append(std::bit_cast<std::uint32_t>(static_cast<float>(vector[k])), 4);
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, target_vertices)},
                                {"componentType", component_float},
                                {"count", vectors.size()},
                                {"type", "VEC" + std::to_string(Vector::length())}});
    return buffer.accessors.size() - 1;
}

/// JOINTS_0, in bytes, and WEIGHTS_0, in floats.
std::size_t add_joints(Buffer& buffer, const std::vector<Influence>& influences);
std::size_t add_weights(Buffer& buffer, const std::vector<Influence>& influences);

std::size_t add_indices(Buffer& buffer, const std::vector<glm::uvec3>& triangles);

/// The times of an animation's key frames, in seconds, and the values there.
std::size_t add_times(Buffer& buffer, const std::vector<float>& times);
std::size_t add_key_values(Buffer& buffer, const Track& track);

} // namespace shadowproof::author
