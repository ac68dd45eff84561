#include "scenes/stress/parameters.h"
#include "scenes/stress/place.h"
#include "scenes/stress/replaced_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// The picture's height at the distance at which something is seen.
double picture_height_at(const Scene& scene, double distance) {
    return 2 * scene.camera.half_height * (scene.camera.is_orthographic() ? 1 : distance);
}

double longest_edge(const Scene& scene, std::uint32_t triangle) {
    double longest = 0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(longest, glm::distance(corner(scene, triangle, k),
                                                  corner(scene, triangle, (k + 1) % 3)));
    return longest;
}

/// So small that nothing is cut out of a triangle to be as large.
constexpr double largest_share = 0.5;

/// In pixels, half of the main caster's largest triangle's longest edge.
double own_triangle_size(const Scene& scene) {
    const Mesh& mesh = scene.meshes[*main_caster(scene)];
    double longest = 0;
    for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
        longest = std::max(longest, longest_edge(scene, mesh.first_triangle + i));
    const double pixel = picture_height_at(scene, size_of(scene)) / scene.camera.height;
    return longest > 0 ? largest_share * longest / pixel : 1;
}

/// A small triangle of the same shape in the middle, and six others around it. Edges stay whole: no
/// T-junctions.
void add_small(Scene& scene, std::uint32_t number, double pixels,
               std::vector<glm::uvec3>& triangles) {
    const glm::uvec3 t = scene.triangles[number];
    std::array<glm::dvec3, 3> corners{};
    for (int k = 0; k < 3; ++k) corners[static_cast<std::size_t>(k)] = corner(scene, number, k);
    const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const double length = pixels *
                          picture_height_at(scene, glm::distance(middle, scene.camera.eye)) /
                          scene.camera.height;
    const double edge = longest_edge(scene, number);
    const double share = edge > 0 ? std::min(largest_share, length / edge) : largest_share;
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const glm::dvec3& c : corners) scene.positions.emplace_back(middle + share * (c - middle));
    triangles.emplace_back(first, first + 1, first + 2);
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const std::uint32_t inner = first + static_cast<std::uint32_t>(k);
        const std::uint32_t inner_next = first + static_cast<std::uint32_t>(next);
        triangles.emplace_back(t[k], t[next], inner_next);
        triangles.emplace_back(t[k], inner_next, inner);
    }
}

void take_triangle_size(Scene& scene, double value) {
    replace_triangles(
        scene, [](const Mesh& mesh) { return mesh.casts; },
        [&](std::uint32_t number, std::vector<glm::uvec3>& triangles) {
            add_small(scene, number, value, triangles);
        });
}

/// Whether the main receiver is of another mesh than the main caster, which so keeps its shape.
bool has_receiver_of_its_own(const Scene& scene) {
    const std::optional<std::uint32_t> receiver = main_receiver(scene);
    return !is_bump_lit(scene) && receiver && main_caster(scene) &&
           mesh_of(scene, *receiver) != *main_caster(scene);
}

double own_receiver_size(const Scene& scene) {
    return longest_edge(scene, *main_receiver(scene)) / picture_height_at(scene, size_of(scene));
}

/// The receiver's mesh grows along the receiver's plane, about the point there that is nearest to
/// the middle of what is seen.
void take_receiver_size(Scene& scene, double value) {
    const std::uint32_t receiver = *main_receiver(scene);
    const double factor = value / own_receiver_size(scene);
    const std::array<glm::dvec3, 3> t{corner(scene, receiver, 0), corner(scene, receiver, 1),
                                      corner(scene, receiver, 2)};
    const glm::dvec3 normal = unit_or(glm::cross(t[1] - t[0], t[2] - t[0]), {0, 1, 0});
    const glm::dvec3 centre =
        nearest_point(t[0], t[1], t[2], scene.camera.eye + size_of(scene) * scene.camera.forward);
    const Mesh& mesh = scene.meshes[mesh_of(scene, receiver)];
    std::vector<std::uint8_t> grows(scene.positions.size(), 0);
    for (std::uint32_t i = 0; i < mesh.triangle_count; ++i)
        for (int k = 0; k < 3; ++k) grows[scene.triangles[mesh.first_triangle + i][k]] = 1;
    for (std::size_t i = 0; i < grows.size(); ++i) {
        if (grows[i] == 0) continue;
        const glm::dvec3 from_centre = glm::dvec3(scene.positions[i]) - centre;
        const glm::dvec3 along = from_centre - glm::dot(from_centre, normal) * normal;
        scene.positions[i] = glm::vec3(glm::dvec3(scene.positions[i]) + (factor - 1) * along);
    }
}

} // namespace

std::vector<StressParameter> triangle_parameters() {
    return {
        {.name = "triangle_size",
         .words = "the longest edge of a new triangle in each that casts, in pixels",
         .low = 0.01,
         .suits = has_caster_without_bumps,
         .own = own_triangle_size,
         .take = take_triangle_size},
        {.name = "receiver_size",
         .words = "the longest edge of the main receiver, in heights of the picture",
         .high = 1e4,
         .suits = has_receiver_of_its_own,
         .own = own_receiver_size,
         .take = take_receiver_size},
    };
}

} // namespace shadowproof
