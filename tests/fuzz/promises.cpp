#include "tests/fuzz/promises.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace shadowproof::fuzz {

namespace {

template <class Vector>
bool finite(const Vector& v) {
    for (int k = 0; k < Vector::length(); ++k)
        if (!std::isfinite(v[k])) return false;
    return true;
}

bool is_utf8(const std::string& text) {
    try {
        (void)nlohmann::json(text).dump();
        return true;
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

} // namespace

void broken(const std::string& promise) {
    std::fprintf(stderr, "broken promise: %s\n", promise.c_str());
    std::abort();
}

std::optional<std::string> fault_of_message(const std::string& message, const std::string& where) {
    constexpr std::size_t longest = 2000; // bytes
    if (!message.starts_with(where)) return "message-without-place";
    if (message.find(": ") == std::string::npos || message.find("; ") == std::string::npos)
        return "message-without-remedy";
    for (const char c : message)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return "message-control-character";
    if (!is_utf8(message)) return "message-not-utf8";
    if (message.size() > longest) return "message-endless";
    return std::nullopt;
}

void check_scene(const Scene& scene) {
    for (const glm::vec3& position : scene.positions)
        require(finite(position), "positions are finite");
    for (const glm::uvec3& triangle : scene.triangles)
        for (int k = 0; k < 3; ++k)
            require(triangle[k] < scene.positions.size(), "triangles name vertices that there are");
    require(!scene.materials.empty(), "there is a material");
    std::size_t next = 0;
    for (const Mesh& mesh : scene.meshes) {
        require(mesh.first_triangle == next, "meshes follow each other without gaps");
        require(mesh.material < scene.materials.size(), "meshes name materials that there are");
        next += mesh.triangle_count;
    }
    require(next == scene.triangles.size(), "meshes cover all triangles");
    require(scene.surfaces.empty() || scene.surfaces.size() == 3 * scene.triangles.size(),
            "there are three surfaces for each triangle");
    for (const Surface& surface : scene.surfaces)
        require(finite(surface.normal) && finite(surface.tangent) && finite(surface.decal_at) &&
                    finite(surface.bump_at),
                "surfaces are finite");
    for (const Material& material : scene.materials) {
        for (const std::uint32_t texture : {material.decal, material.bump_map})
            require(texture == no_texture || texture < scene.textures.size(),
                    "materials name textures that there are");
        require(finite(material.color) && finite(material.specular) &&
                    finite(material.reflectance) && std::isfinite(material.bump_scale),
                "materials are finite");
    }
    for (const TextureImage& texture : scene.textures) {
        require(texture.texels.width > 0 && texture.texels.height > 0, "textures have texels");
        for (const glm::vec4& texel : texture.texels.pixels)
            require(finite(texel), "texels are finite");
    }
    require(scene.light < scene.lights.size(), "there is a light");
    for (const Light& light : scene.lights)
        require(finite(light.position) && finite(light.direction) && finite(light.color) &&
                    std::isfinite(light.intensity) && std::isfinite(light.inner_cone) &&
                    std::isfinite(light.outer_cone),
                "lights are finite");
    require(finite(scene.ambient), "the ambient light is finite");
}

} // namespace shadowproof::fuzz
