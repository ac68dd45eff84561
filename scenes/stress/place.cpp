#include "scenes/stress/place.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace shadowproof {

double size_of(const Scene& scene) {
    std::vector<double> distances;
    for (const glm::vec3& position : scene.positions)
        distances.push_back(glm::distance(glm::dvec3(position), scene.camera.eye));
    if (distances.empty()) return 1;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle > 0 ? *middle : 1;
}

std::optional<std::uint32_t> main_caster(const Scene& scene) {
    std::optional<std::uint32_t> best;
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        if (!mesh.casts || mesh.triangle_count == 0) continue;
        if (!best || mesh.triangle_count > scene.meshes[*best].triangle_count) best = i;
    }
    return best;
}

bool has_caster_without_bumps(const Scene& scene) {
    return !is_bump_lit(scene) && !has_masks(scene) && main_caster(scene).has_value();
}

namespace {

template <class Visit>
void each_triangle(const Mesh& mesh, const Visit& visit) {
    for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) visit(mesh.first_triangle + i);
}

/// Keeps the candidate that is nearest to a point.
struct Nearest {
    glm::dvec3 to;
    glm::dvec3 point{0, 0, 0};
    double distance = std::numeric_limits<double>::infinity();

    void offer(const glm::dvec3& candidate) {
        const double other = glm::distance(candidate, to);
        if (!(other < distance)) return;
        distance = other;
        point = candidate;
    }
};

} // namespace

double diagonal_of(const Scene& scene, const Mesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    each_triangle(mesh, [&](std::uint32_t triangle) {
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, corner(scene, triangle, k));
            high = glm::max(high, corner(scene, triangle, k));
        }
    });
    const double diagonal = glm::distance(low, high);
    return diagonal > 0 && std::isfinite(diagonal) ? diagonal : 1;
}

glm::dvec3 nearest_point(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                         const glm::dvec3& to) {
    const auto on_segment = [&](const glm::dvec3& from, const glm::dvec3& until) {
        const glm::dvec3 along = until - from;
        const double square = glm::dot(along, along);
        if (!(square > 0)) return from;
        return from + std::clamp(glm::dot(to - from, along) / square, 0.0, 1.0) * along;
    };
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double square = glm::dot(normal, normal);
    if (square > 0) {
        const double u = glm::dot(glm::cross(b - a, to - a), normal) / square; // of c
        const double v = glm::dot(glm::cross(to - a, c - a), normal) / square; // of b
        if (u >= 0 && v >= 0 && u + v <= 1) return a + v * (b - a) + u * (c - a);
    }
    Nearest nearest{to};
    nearest.offer(on_segment(a, b));
    nearest.offer(on_segment(b, c));
    nearest.offer(on_segment(c, a));
    return nearest.point;
}

glm::dvec3 nearest_face_point(const Scene& scene, const Mesh& mesh, const glm::dvec3& to) {
    Nearest nearest{to};
    each_triangle(mesh, [&](std::uint32_t triangle) {
        nearest.offer(nearest_point(corner(scene, triangle, 0), corner(scene, triangle, 1),
                                    corner(scene, triangle, 2), to));
    });
    return nearest.point;
}

glm::dvec3 nearest_vertex(const Scene& scene, const Mesh& mesh, const glm::dvec3& to) {
    Nearest nearest{to};
    each_triangle(mesh, [&](std::uint32_t triangle) {
        for (int k = 0; k < 3; ++k) nearest.offer(corner(scene, triangle, k));
    });
    return nearest.point;
}

glm::dvec3 nearest_edge_middle(const Scene& scene, const Mesh& mesh, const glm::dvec3& to) {
    Nearest nearest{to};
    each_triangle(mesh, [&](std::uint32_t triangle) {
        for (int k = 0; k < 3; ++k)
            nearest.offer(0.5 *
                          (corner(scene, triangle, k) + corner(scene, triangle, (k + 1) % 3)));
    });
    return nearest.point;
}

glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& otherwise) {
    const double length = glm::length(vector);
    return length > 0 && std::isfinite(length) ? vector / length : otherwise;
}

std::optional<std::uint32_t> main_receiver(const Scene& scene) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec4 eye = homogeneous_eye(scene.camera);
    const std::vector<std::uint8_t> receives = receiving_triangles(scene);
    const std::vector<std::uint8_t> both_sides = double_sided_triangles(scene);
    std::optional<std::uint32_t> best;
    double largest = 0;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const glm::dvec3 a = corner(scene, i, 0);
        const double area =
            glm::length(glm::cross(corner(scene, i, 1) - a, corner(scene, i, 2) - a));
        if (receives[i] == 0 || !(area > largest)) continue;
        const double to_eye = side(scene, i, eye);
        const double to_light = side(scene, i, light);
        const bool one_side =
            (to_eye > 0 && to_light > 0) || (both_sides[i] != 0 && to_eye < 0 && to_light < 0);
        if (!one_side) continue;
        best = i;
        largest = area;
    }
    return best;
}

} // namespace shadowproof
