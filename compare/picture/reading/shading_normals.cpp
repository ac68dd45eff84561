#include "compare/picture/reading/shading_normals.h"

#include "scenes/mesh/smooth_normals.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

namespace shadowproof {

namespace {

glm::dvec3 across(const Scene& scene, std::uint32_t triangle) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    return glm::cross(corner(scene, triangle, 1) - a, corner(scene, triangle, 2) - a);
}

/// A mesh by itself: its triangles are into its own vertices.
struct OwnMesh {
    std::vector<std::uint32_t> vertices; ///< of the scene
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
};

OwnMesh own_mesh(const Scene& scene, const Mesh& mesh) {
    const std::span<const glm::uvec3> triangles(scene.triangles.data() + mesh.first_triangle,
                                                mesh.triangle_count);
    OwnMesh own;
    std::vector<std::uint32_t>& vertices = own.vertices;
    vertices.reserve(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles)
        vertices.insert(vertices.end(), {triangle.x, triangle.y, triangle.z});
    std::ranges::sort(vertices);
    const auto repeated = std::ranges::unique(vertices);
    vertices.erase(repeated.begin(), repeated.end());
    const auto index_of = [&](std::uint32_t vertex) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, vertex) -
                                          vertices.begin());
    };
    own.positions.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) own.positions.emplace_back(scene.positions[vertex]);
    own.triangles.reserve(triangles.size());
    for (const glm::uvec3& triangle : triangles)
        own.triangles.emplace_back(index_of(triangle.x), index_of(triangle.y),
                                   index_of(triangle.z));
    return own;
}

std::vector<glm::dvec3> by_areas(const OwnMesh& mesh) {
    std::vector<glm::dvec3> normals(mesh.positions.size(), glm::dvec3(0));
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[triangle.x];
        const glm::dvec3 twice_area =
            glm::cross(mesh.positions[triangle.y] - a, mesh.positions[triangle.z] - a);
        for (int k = 0; k < 3; ++k) normals[triangle[k]] += twice_area;
    }
    for (glm::dvec3& normal : normals) normal = glm::normalize(normal);
    return normals;
}

} // namespace

ShadingNormals::ShadingNormals(const Scene& scene, std::vector<std::uint32_t> triangles)
    : scene_(scene), triangles_(std::move(triangles)) {
    for (std::vector<Corners>& corners : corners_) corners.reserve(triangles_.size());
    auto next = triangles_.begin();
    while (next != triangles_.end()) {
        const Mesh& mesh = scene.meshes[mesh_of(scene, *next)];
        const auto end = std::find_if(next, triangles_.end(), [&](std::uint32_t triangle) {
            return triangle - mesh.first_triangle >= mesh.triangle_count;
        });
        const OwnMesh own = own_mesh(scene, mesh);
        std::vector<glm::dvec3> by_vertices = smooth_normals(own.positions, own.triangles);
        if (!scene.normals.empty())
            for (std::size_t i = 0; i < own.vertices.size(); ++i)
                if (const glm::vec3 given = scene.normals[own.vertices[i]]; given != glm::vec3(0))
                    by_vertices[i] = given;
        const std::vector<glm::dvec3> of_areas = by_areas(own);
        for (; next != end; ++next) {
            const glm::uvec3& triangle = own.triangles[*next - mesh.first_triangle];
            const auto at_corners = [&](const std::vector<glm::dvec3>& normals) {
                return Corners{normals[triangle.x], normals[triangle.y], normals[triangle.z]};
            };
            corners_[0].push_back(at_corners(by_vertices));
            corners_[1].push_back(at_corners(of_areas));
        }
    }
}

glm::dvec3 ShadingNormals::at(NormalsBy by, std::uint32_t triangle, const glm::dvec3& point) const {
    const glm::dvec3 flat = across(scene_, triangle);
    if (by == NormalsBy::faces) return flat;
    const auto place = std::ranges::lower_bound(triangles_, triangle) - triangles_.begin();
    const Corners& corners =
        corners_[by == NormalsBy::areas ? 1 : 0][static_cast<std::size_t>(place)];
    // The parts into which the point divides the triangle, each opposite the corner it weighs.
    const glm::dvec3 to_a = corner(scene_, triangle, 0) - point;
    const glm::dvec3 to_b = corner(scene_, triangle, 1) - point;
    const glm::dvec3 to_c = corner(scene_, triangle, 2) - point;
    return glm::dot(glm::cross(to_b, to_c), flat) * glm::dvec3(corners[0]) +
           glm::dot(glm::cross(to_c, to_a), flat) * glm::dvec3(corners[1]) +
           glm::dot(glm::cross(to_a, to_b), flat) * glm::dvec3(corners[2]);
}

} // namespace shadowproof
