#include "raster/volumes/volume.h"

#include "scenes/mesh/half_edge.h"
#include "scenes/mesh/topology.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

/// The volume over the triangles that face the light, without its sides.
ShadowVolume capped(const Scene& scene) {
    const auto far_end = static_cast<std::uint32_t>(scene.positions.size());
    ShadowVolume volume;
    volume.facing = triangles_facing_light(scene);
    volume.light_cap.reserve(volume.facing.size());
    volume.dark_cap.reserve(volume.facing.size());
    for (const std::uint32_t triangle : volume.facing) {
        const glm::uvec3 corners = scene.triangles[triangle];
        volume.light_cap.push_back(corners);
        volume.dark_cap.emplace_back(corners.z + far_end, corners.y + far_end, corners.x + far_end);
    }
    return volume;
}

} // namespace

std::vector<std::uint32_t> triangles_facing_light(const Scene& scene) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    std::vector<std::uint32_t> facing;
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        if (side(scene, triangle, light) > 0) facing.push_back(triangle);
    return facing;
}

void append_side(std::uint32_t a, std::uint32_t b, std::uint32_t position_count,
                 ShadowVolume& volume) {
    const std::uint32_t low = std::min(a, b);
    const std::uint32_t high = std::max(a, b);
    std::vector<glm::uvec3>& sides = a < b ? volume.sides : volume.flipped_sides;
    sides.emplace_back(high, low, low + position_count);
    sides.emplace_back(high, low + position_count, high + position_count);
}

Extruder by_silhouettes(const Scene& scene) {
    return [&scene, welded = weld_by_position(scene.positions)] {
        const auto position_count = static_cast<std::uint32_t>(scene.positions.size());
        ShadowVolume volume = capped(scene);
        for (const auto& [a, b, surplus] : boundary(scene, welded, volume.facing))
            for (int i = 0; i < surplus; ++i) append_side(a, b, position_count, volume);
        return volume;
    };
}

Extruder by_half_edges(const Scene& scene) {
    return [&scene, mesh = connect_all(scene)] {
        const auto position_count = static_cast<std::uint32_t>(scene.positions.size());
        ShadowVolume volume = capped(scene);
        std::vector<std::uint8_t> faces(scene.triangles.size(), 0);
        for (const std::uint32_t triangle : volume.facing) faces[triangle] = 1;
        for (const HalfEdge& half_edge : mesh.half_edges) {
            if (faces[half_edge.triangle] == 0) continue;
            const bool inner = half_edge.twin != no_half_edge &&
                               faces[mesh.half_edges[half_edge.twin].triangle] != 0;
            if (!inner)
                append_side(half_edge.origin, mesh.half_edges[half_edge.next].origin,
                            position_count, volume);
        }
        return volume;
    };
}

Extruder by_triangles(const Scene& scene) {
    return [&scene, welded = weld_by_position(scene.positions)] {
        const auto position_count = static_cast<std::uint32_t>(scene.positions.size());
        ShadowVolume volume = capped(scene);
        for (const std::uint32_t triangle : volume.facing)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = welded[scene.triangles[triangle][k]];
                const std::uint32_t b = welded[scene.triangles[triangle][(k + 1) % 3]];
                if (a != b) append_side(a, b, position_count, volume);
            }
        return volume;
    };
}

void set_special_caps(const SpecialCaps& special, ShadowVolume& volume) {
    const auto is = [](const std::vector<std::uint8_t>& flags, std::uint32_t triangle) {
        return triangle < flags.size() && flags[triangle] != 0;
    };
    const std::vector<glm::uvec3> caps = std::exchange(volume.light_cap, {});
    for (std::size_t i = 0; i < caps.size(); ++i) {
        const std::uint32_t triangle = volume.facing[i];
        if (is(special.hidden, triangle)) continue;
        if (is(special.flipped, triangle))
            volume.flipped_caps.emplace_back(caps[i].y, caps[i].x, caps[i].z);
        else
            volume.light_cap.push_back(caps[i]);
    }
}

Extruder with_special_caps(Extruder extruder, SpecialCaps special) {
    if (special.hidden.empty() && special.flipped.empty()) return extruder;
    return [extruder = std::move(extruder), special = std::move(special)] {
        ShadowVolume volume = extruder();
        set_special_caps(special, volume);
        return volume;
    };
}

} // namespace shadowproof
