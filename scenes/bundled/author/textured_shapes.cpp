#include "scenes/bundled/author/shapes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <utility>

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
        // On the sides the picture is upright, and its right is to the right as seen from outside.
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

namespace {

/// The outline's normal at a ring, from its neighbours: (outward, up), unit.
glm::dvec2 outline_normal(const std::vector<Ring>& rings, std::size_t j) {
    if (j == 0) return {0, 1};
    if (j + 1 == rings.size()) return {0, -1};
    const Ring& above = rings[j - 1];
    const Ring& below = rings[j + 1];
    return glm::normalize(glm::dvec2(above.height - below.height, below.radius - above.radius));
}

/// How far down the outline each ring lies, as a share of its length.
std::vector<double> shares_of(const std::vector<Ring>& rings) {
    std::vector<double> lengths{0};
    for (std::size_t j = 1; j < rings.size(); ++j)
        lengths.push_back(lengths.back() + std::hypot(rings[j].radius - rings[j - 1].radius,
                                                      rings[j].height - rings[j - 1].height));
    for (double& length : lengths) length /= lengths.back();
    return lengths;
}

} // namespace

Shape textured_lathe(const std::vector<Ring>& rings, double depth, unsigned around, Wearing wearing,
                     const glm::dvec2& repeats) {
    Shape shape;
    const std::vector<double> down = shares_of(rings);
    for (std::size_t j = 0; j < rings.size(); ++j)
        for (unsigned i = 0; i <= around; ++i) {
            const double angle = turn * (i % around) / around; // from +z over +x
            const double share = static_cast<double>(i) / around;
            const glm::dvec2 normal = outline_normal(rings, j);
            shape.vertices.emplace_back(rings[j].radius * std::sin(angle), rings[j].height,
                                        depth * rings[j].radius * std::cos(angle));
            shape.normals.push_back(glm::normalize(glm::dvec3(normal.x * std::sin(angle), normal.y,
                                                              normal.x * std::cos(angle) / depth)));
            if (wearing == Wearing::around)
                shape.tangents.emplace_back(
                    glm::normalize(glm::dvec3(std::cos(angle), 0, -depth * std::sin(angle))), 1);
            const double across = wearing == Wearing::around ? share : 1 - std::abs(2 * share - 1);
            shape.coordinates.emplace_back(repeats.x * across, repeats.y * down[j]);
        }
    add_grid(shape, around, static_cast<unsigned>(rings.size()) - 1);
    std::erase_if(shape.triangles, [&](const glm::uvec3& t) { return !has_area(shape, t); });
    return shape;
}

std::vector<Ring> capsule(double radius, double half_length, unsigned cap_rings) {
    std::vector<Ring> rings;
    for (const int end : {1, -1})
        for (unsigned j = 0; j <= cap_rings; ++j) {
            const unsigned from_pole = end > 0 ? j : cap_rings - j;
            const double angle = turn / 4 * from_pole / cap_rings;
            rings.push_back({from_pole == 0 ? 0 : radius * std::sin(angle),
                             end * (half_length + radius * std::cos(angle))});
        }
    return rings;
}

namespace {

/// The vertices along the border of a grid, each once, counter-clockwise from above.
std::vector<unsigned> border_of_grid(unsigned segments) {
    const auto vertex = [&](unsigned i, unsigned j) { return j * (segments + 1) + i; };
    std::vector<unsigned> border;
    for (unsigned j = 0; j < segments; ++j) border.push_back(vertex(0, j));
    for (unsigned i = 0; i < segments; ++i) border.push_back(vertex(i, segments));
    for (unsigned j = segments; j > 0; --j) border.push_back(vertex(segments, j));
    for (unsigned i = segments; i > 0; --i) border.push_back(vertex(i, 0));
    return border;
}

unsigned add_vertex(Shape& shape, const glm::dvec3& point, const glm::dvec3& normal,
                    const glm::dvec2& at) {
    shape.vertices.push_back(point);
    shape.normals.push_back(normal);
    shape.coordinates.push_back(at);
    return static_cast<unsigned>(shape.vertices.size()) - 1;
}

} // namespace

Shape textured_ground(const glm::dvec3& half_size, unsigned segments, const Ground& ground,
                      double border) {
    Shape shape;
    for (unsigned j = 0; j <= segments; ++j) // from the back: the picture's top
        for (unsigned i = 0; i <= segments; ++i) {
            const glm::dvec2 share(static_cast<double>(i) / segments,
                                   static_cast<double>(j) / segments);
            const double x = half_size.x * (2 * share.x - 1);
            const double z = half_size.z * (2 * share.y - 1);
            const glm::dvec3 height = ground(x, z);
            add_vertex(shape, {x, half_size.y + height.x, z},
                       glm::normalize(glm::dvec3(-height.y, 1, -height.z)),
                       share * (1 + 2 * border) - border);
        }
    add_grid(shape, segments, segments);
    const std::vector<unsigned> rim = border_of_grid(segments);
    const unsigned middle = add_vertex(shape, {0, -half_size.y, 0}, {0, -1, 0}, {0.5, 0.5});
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const unsigned corners[2]{rim[i], rim[(i + 1) % rim.size()]};
        const glm::dvec3 along = shape.vertices[corners[1]] - shape.vertices[corners[0]];
        const glm::dvec3 out = glm::normalize(glm::dvec3(-along.z, 0, along.x));
        unsigned top[2];
        unsigned low[2];
        unsigned under[2];
        for (std::size_t k = 0; k < 2; ++k) {
            const glm::dvec3 point = shape.vertices[corners[k]];
            const glm::dvec3 foot(point.x, -half_size.y, point.z);
            const glm::dvec2 at = shape.coordinates[corners[k]];
            top[k] = add_vertex(shape, point, out, at);
            low[k] = add_vertex(shape, foot, out, at + 0.1 * glm::dvec2(out.x, out.z));
            under[k] = add_vertex(shape, foot, {0, -1, 0}, at);
        }
        shape.triangles.emplace_back(top[0], low[0], low[1]);
        shape.triangles.emplace_back(top[0], low[1], top[1]);
        shape.triangles.emplace_back(middle, under[1], under[0]);
    }
    return shape;
}

Shape mirrored(const Shape& shape) {
    Shape image = shape;
    for (glm::dvec3& vertex : image.vertices) vertex.x = -vertex.x;
    for (glm::dvec3& normal : image.normals) normal.x = -normal.x;
    for (glm::dvec4& tangent : image.tangents) tangent *= glm::dvec4(-1, 1, 1, -1);
    for (glm::uvec3& triangle : image.triangles) std::swap(triangle.y, triangle.z);
    return image;
}

Shape moved(const Shape& shape, const glm::dvec3& way) {
    Shape image = shape;
    for (glm::dvec3& vertex : image.vertices) vertex += way;
    return image;
}

Shape joined(const std::vector<Shape>& shapes) {
    Shape all;
    const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    for (const Shape& shape : shapes) {
        const auto first = static_cast<unsigned>(all.vertices.size());
        for (const glm::uvec3& triangle : shape.triangles)
            all.triangles.push_back(triangle + first);
        append(all.vertices, shape.vertices);
        append(all.normals, shape.normals);
        append(all.coordinates, shape.coordinates);
        append(all.tangents, shape.tangents);
    }
    return all;
}

} // namespace shadowproof::author
