#include "scenes/bundled/author/shapes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace shadowproof::author {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Squares between rows of `columns + 1` vertices, the first two of a row to the left and right
/// of each other as seen from outside, the rows from the top.
void add_grid(Shape& shape, unsigned columns, unsigned rows) {
    const auto vertex = [&](unsigned i, unsigned j) { return j * (columns + 1) + i; };
    for (unsigned j = 0; j < rows; ++j)
        for (unsigned i = 0; i < columns; ++i) {
            shape.triangles.emplace_back(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1));
            shape.triangles.emplace_back(vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j));
        }
}

bool has_area(const Shape& shape, const glm::uvec3& t) {
    return shape.vertices[t.x] != shape.vertices[t.y] &&
           shape.vertices[t.y] != shape.vertices[t.z] && shape.vertices[t.z] != shape.vertices[t.x];
}

/// The direction at a share of the way around the y axis (from +z over +x) and down from the pole.
glm::dvec3 direction(unsigned i, unsigned around, unsigned j, unsigned down) {
    if (j == 0 || j == down) return {0, j == 0 ? 1 : -1, 0};
    const double longitude = turn * (i % around) / around;
    const double from_pole = turn / 2 * j / down;
    return {std::sin(from_pole) * std::sin(longitude), std::cos(from_pole),
            std::sin(from_pole) * std::cos(longitude)};
}

} // namespace

Shape textured_ball(const glm::dvec3& radii, unsigned around, unsigned down, Wearing wearing,
                    const glm::dvec2& repeats) {
    Shape shape;
    for (unsigned j = 0; j <= down; ++j)
        for (unsigned i = 0; i <= around; ++i) {
            const glm::dvec3 out = direction(i, around, j, down);
            shape.vertices.push_back(radii * out);
            shape.normals.push_back(glm::normalize(out / radii));
            const double share = static_cast<double>(i) / around;
            const double across = wearing == Wearing::around ? share : 1 - std::abs(2 * share - 1);
            shape.coordinates.emplace_back(repeats.x * across, repeats.y * j / down);
        }
    add_grid(shape, around, down);
    std::erase_if(shape.triangles, [&](const glm::uvec3& t) { return !has_area(shape, t); });
    return shape;
}

Shape textured_torus(double ring_radius, double tube_radius, unsigned ring, unsigned tube,
                     const glm::dvec2& repeats) {
    Shape shape;
    for (unsigned j = 0; j <= tube; ++j)
        for (unsigned i = 0; i <= ring; ++i) {
            const double around = turn * (i % ring) / ring;
            const double across = -turn * (j % tube) / tube; // down on the outside
            const glm::dvec3 out(std::cos(across) * std::sin(around), std::sin(across),
                                 std::cos(across) * std::cos(around));
            const glm::dvec3 centre(ring_radius * std::sin(around), 0,
                                    ring_radius * std::cos(around));
            shape.vertices.push_back(centre + tube_radius * out);
            shape.normals.push_back(out);
            shape.tangents.emplace_back(std::cos(around), 0, -std::sin(around), 1);
            shape.coordinates.emplace_back(repeats.x * i / ring, repeats.y * j / tube);
        }
    add_grid(shape, ring, tube);
    return shape;
}

Shape textured_box(const glm::dvec3& half_size, unsigned segments) {
    Shape shape = box(half_size, segments);
    Shape faces;
    for (const glm::uvec3& triangle : shape.triangles) {
        const glm::dvec3 a = shape.vertices[triangle.x];
        const glm::dvec3 across =
            glm::cross(shape.vertices[triangle.y] - a, shape.vertices[triangle.z] - a);
        const glm::dvec3 size = glm::abs(across);
        const int axis = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
        glm::dvec3 normal(0);
        normal[axis] = across[axis] > 0 ? 1 : -1;
        // The picture stands upright on the sides, and its right is to the right from outside.
        const glm::dvec3 up = axis == 1 ? glm::dvec3(0, 0, -normal.y) : glm::dvec3(0, 1, 0);
        const glm::dvec3 right = glm::cross(up, normal);
        const auto first = static_cast<unsigned>(faces.vertices.size());
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& point = shape.vertices[triangle[k]];
            faces.vertices.push_back(point);
            faces.normals.push_back(normal);
            faces.coordinates.emplace_back(
                0.5 + 0.5 * glm::dot(point, right) / glm::dot(half_size, glm::abs(right)),
                0.5 - 0.5 * glm::dot(point, up) / glm::dot(half_size, glm::abs(up)));
        }
        faces.triangles.emplace_back(first, first + 1, first + 2);
    }
    return faces;
}

} // namespace shadowproof::author
