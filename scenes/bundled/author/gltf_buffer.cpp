#include "scenes/bundled/author/gltf_buffer.h"

#include <algorithm>
#include <glm/common.hpp>
#include <string_view>

namespace shadowproof::author {

namespace {

constexpr int component_unsigned_byte = 5121;
constexpr int component_unsigned_short = 5123;
constexpr int target_indices = 34963;

} // namespace

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t length = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < length ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= length ? digits[group >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

std::size_t add_positions(Buffer& buffer, const std::vector<glm::dvec3>& vertices,
                          std::optional<int> target) {
    const std::size_t offset = buffer.bytes.size();
    glm::vec3 low(vertices.front());
    glm::vec3 high = low;
    for (const glm::dvec3& vertex : vertices) {
        const glm::vec3 rounded(vertex);
        low = glm::min(low, rounded);
        high = glm::max(high, rounded);
        for (int k = 0; k < 3; ++k) buffer.append(std::bit_cast<std::uint32_t>(rounded[k]), 4);
    }
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, target)},
                                {"componentType", component_float},
                                {"count", vertices.size()},
                                {"type", "VEC3"},
                                {"min", array(low)},
                                {"max", array(high)}});
    return buffer.accessors.size() - 1;
}

std::size_t add_joints(Buffer& buffer, const std::vector<Influence>& influences) {
    const std::size_t offset = buffer.bytes.size();
    for (const Influence& influence : influences)
        for (int k = 0; k < 4; ++k) buffer.append(influence.joints[k], 1);
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, target_vertices)},
                                {"componentType", component_unsigned_byte},
                                {"count", influences.size()},
                                {"type", "VEC4"}});
    return buffer.accessors.size() - 1;
}

std::size_t add_weights(Buffer& buffer, const std::vector<Influence>& influences) {
    std::vector<glm::dvec4> weights;
    weights.reserve(influences.size());
    for (const Influence& influence : influences) weights.push_back(influence.weights);
    return add_vectors(buffer, weights);
}

std::size_t add_indices(Buffer& buffer, const std::vector<glm::uvec3>& triangles) {
    const std::size_t offset = buffer.bytes.size();
    for (const glm::uvec3& triangle : triangles)
        for (int k = 0; k < 3; ++k) buffer.append(triangle[k], 2);
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, target_indices)},
                                {"componentType", component_unsigned_short},
                                {"count", 3 * triangles.size()},
                                {"type", "SCALAR"}});
    return buffer.accessors.size() - 1;
}

std::size_t add_times(Buffer& buffer, const std::vector<float>& times) {
    const std::size_t offset = buffer.bytes.size();
    for (const float time : times) buffer.append(std::bit_cast<std::uint32_t>(time), 4);
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, std::nullopt)},
                                {"componentType", component_float},
                                {"count", times.size()},
                                {"type", "SCALAR"},
                                {"min", Json::array({times.front()})},
                                {"max", Json::array({times.back()})}});
    return buffer.accessors.size() - 1;
}

std::size_t add_key_values(Buffer& buffer, const Track& track) {
    const std::size_t offset = buffer.bytes.size();
    for (const double value : track.values)
        buffer.append(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
    const std::size_t width =
        track.path == "weights" ? 1 : track.values.size() / track.times.size();
    buffer.accessors.push_back({{"bufferView", buffer.close_view(offset, std::nullopt)},
                                {"componentType", component_float},
                                {"count", track.values.size() / width},
                                {"type", width == 1 ? "SCALAR" : "VEC" + std::to_string(width)}});
    return buffer.accessors.size() - 1;
}

} // namespace shadowproof::author
