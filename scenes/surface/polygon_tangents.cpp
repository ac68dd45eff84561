#include "scenes/surface/polygon_tangents.h"

#include "scenes/surface/plane_equations.h"

#include <array>

namespace shadowproof {

std::vector<Surface> surfaces_with_polygon_tangents(const Scene& scene) {
    std::vector<Surface> surfaces = scene.surfaces;
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        const Mesh& mesh = scene.meshes[mesh_of(scene, triangle)];
        if (scene.materials[mesh.material].bump == Bump::none) continue;
        Surface* const corners = &surfaces[std::size_t{3} * triangle];
        std::array<glm::dvec3, 3> positions{};
        std::array<glm::dvec2, 3> at{};
        for (int k = 0; k < 3; ++k) {
            positions[static_cast<std::size_t>(k)] = scene.positions[scene.triangles[triangle][k]];
            at[static_cast<std::size_t>(k)] = corners[k].bump_at;
        }
        const glm::vec3 along(directions_of(plane_equations(positions, at)).along_s);
        if (along == glm::vec3(0)) continue;
        for (int k = 0; k < 3; ++k) corners[k].tangent = glm::vec4(along, corners[k].tangent.w);
    }
    return surfaces;
}

} // namespace shadowproof
