#include "scenes/scene.h"

#include "scenes/orientation.h"

#include <algorithm>
#include <utility>

namespace shadowproof {

glm::dvec4 homogeneous(const Light& light) {
    return light.kind == Light::Kind::directional ? glm::dvec4(-light.direction, 0)
                                                  : glm::dvec4(light.position, 1);
}

namespace {

bool is_before(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.z < b.z);
}

} // namespace

double side(const Scene& scene, std::uint32_t triangle, const glm::dvec4& point) {
    glm::dvec3 a = corner(scene, triangle, 0);
    glm::dvec3 b = corner(scene, triangle, 1);
    glm::dvec3 c = corner(scene, triangle, 2);
    for (int turn = 0; turn < 2 && (is_before(b, a) || is_before(c, a)); ++turn) {
        std::swap(a, b);
        std::swap(b, c);
    }
    return orientation(a, b, c, point);
}

std::uint32_t mesh_of(const Scene& scene, std::uint32_t triangle) {
    const auto after = std::upper_bound(
        scene.meshes.begin(), scene.meshes.end(), triangle,
        [](std::uint32_t value, const Mesh& mesh) { return value < mesh.first_triangle; });
    return static_cast<std::uint32_t>(after - scene.meshes.begin()) - 1;
}

namespace {

template <class Holds>
std::vector<std::uint8_t> triangles_where(const Scene& scene, const Holds& holds) {
    std::vector<std::uint8_t> flags(scene.triangles.size(), 0);
    for (const Mesh& mesh : scene.meshes)
        if (holds(mesh))
            std::fill_n(flags.begin() + mesh.first_triangle, mesh.triangle_count, std::uint8_t{1});
    return flags;
}

} // namespace

std::vector<std::uint8_t> double_sided_triangles(const Scene& scene) {
    return triangles_where(
        scene, [&](const Mesh& mesh) { return scene.materials[mesh.material].double_sided; });
}

std::vector<std::uint8_t> casting_triangles(const Scene& scene) {
    return triangles_where(scene, [](const Mesh& mesh) { return mesh.casts; });
}

std::vector<std::uint8_t> receiving_triangles(const Scene& scene) {
    return triangles_where(scene, [](const Mesh& mesh) { return mesh.receives; });
}

std::vector<std::uint32_t> masks_of_triangles(const Scene& scene) {
    if (!has_masks(scene)) return {};
    std::vector<std::uint32_t> masks(scene.triangles.size(), no_mask);
    for (const Mesh& mesh : scene.meshes)
        std::fill_n(masks.begin() + mesh.first_triangle, mesh.triangle_count,
                    scene.materials[mesh.material].mask);
    return masks;
}

std::vector<Scene> under_lights_before(const Scene& scene) {
    std::vector<Scene> each;
    for (std::size_t light = 0; light + 1 < added_lights(scene); ++light) {
        each.push_back(scene);
        each.back().light = light;
    }
    return each;
}

} // namespace shadowproof
