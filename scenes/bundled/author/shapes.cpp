#include "scenes/bundled/author/shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace shadowproof::author {

namespace {

/// Merges equal points to one vertex.
class Welder {
public:
    explicit Welder(Shape& shape) : shape_(shape) {}

    unsigned vertex(const glm::dvec3& point) {
        const auto next = static_cast<unsigned>(shape_.vertices.size());
        const auto [place, is_new] = known_.try_emplace({point.x, point.y, point.z}, next);
        if (is_new) shape_.vertices.push_back(point);
        return place->second;
    }

private:
    Shape& shape_;
    std::map<std::tuple<double, double, double>, unsigned> known_;
};

void add_square(Shape& shape, unsigned a, unsigned b, unsigned c, unsigned d) {
    shape.triangles.emplace_back(a, b, c);
    shape.triangles.emplace_back(a, c, d);
}

/// The icosahedron's corners are the cyclic permutations of (0, +-1, +-golden ratio).
Shape icosahedron() {
    const double g = std::numbers::phi;
    return {{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

Shape subdivided(const Shape& coarse) {
    Shape fine{coarse.vertices, {}};
    std::map<std::pair<unsigned, unsigned>, unsigned> middles;
    const auto middle = [&](unsigned a, unsigned b) {
        const auto next = static_cast<unsigned>(fine.vertices.size());
        const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), next);
        if (is_new) fine.vertices.push_back(glm::normalize(fine.vertices[a] + fine.vertices[b]));
        return place->second;
    };
    for (const glm::uvec3& t : coarse.triangles) {
        const unsigned xy = middle(t.x, t.y);
        const unsigned yz = middle(t.y, t.z);
        const unsigned zx = middle(t.z, t.x);
        for (const glm::uvec3 part : {glm::uvec3(t.x, xy, zx), glm::uvec3(t.y, yz, xy),
                                      glm::uvec3(t.z, zx, yz), glm::uvec3(xy, yz, zx)})
            fine.triangles.push_back(part);
    }
    return fine;
}

} // namespace

Shape box(const glm::dvec3& half_size, unsigned segments) {
    return box(half_size, glm::uvec3(segments));
}

Shape box(const glm::dvec3& half_size, const glm::uvec3& segments) {
    Shape shape;
    Welder welder(shape);
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
            const unsigned count = segments[axis];
            const auto step = [&](unsigned i) { return 2.0 * i / count - 1; };
            // u, v and the outward normal are a right-handed frame on both sides.
            const int u = side > 0 ? (axis + 1) % 3 : (axis + 2) % 3;
            const int v = side > 0 ? (axis + 2) % 3 : (axis + 1) % 3;
            const auto corner = [&](unsigned i, unsigned j) {
                glm::dvec3 point;
                point[axis] = side * half_size[axis];
                point[u] = step(i) * half_size[u];
                point[v] = step(j) * half_size[v];
                return welder.vertex(point);
            };
            for (unsigned i = 0; i < count; ++i)
                for (unsigned j = 0; j < count; ++j)
                    add_square(shape, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
                               corner(i, j + 1));
        }
    return shape;
}

Shape ball(double radius, unsigned subdivisions) {
    Shape shape = icosahedron();
    for (glm::dvec3& vertex : shape.vertices) vertex = glm::normalize(vertex);
    for (unsigned i = 0; i < subdivisions; ++i) shape = subdivided(shape);
    for (glm::dvec3& vertex : shape.vertices) vertex *= radius;
    return shape;
}

Shape torus(double ring_radius, double tube_radius, unsigned ring, unsigned tube) {
    Shape shape;
    for (unsigned i = 0; i < ring; ++i)
        for (unsigned j = 0; j < tube; ++j) {
            const double around = 2 * std::numbers::pi * i / ring;
            const double across = 2 * std::numbers::pi * j / tube;
            const double radius = ring_radius + tube_radius * std::cos(across);
            shape.vertices.emplace_back(radius * std::cos(around), tube_radius * std::sin(across),
                                        radius * std::sin(around));
        }
    const auto vertex = [&](unsigned i, unsigned j) { return (i % ring) * tube + j % tube; };
    for (unsigned i = 0; i < ring; ++i)
        for (unsigned j = 0; j < tube; ++j)
            add_square(shape, vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1),
                       vertex(i + 1, j));
    return shape;
}

Shape disc(double radius, double half_height, unsigned sides) {
    Shape shape{{{0, half_height, 0}, {0, -half_height, 0}}, {}};
    for (unsigned i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        for (const double y : {half_height, -half_height})
            shape.vertices.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
    for (unsigned i = 0; i < sides; ++i) {
        const unsigned top = 2 + 2 * i;
        const unsigned next = 2 + 2 * ((i + 1) % sides);
        shape.triangles.emplace_back(0, next, top);
        shape.triangles.emplace_back(1, top + 1, next + 1);
        add_square(shape, top, next, next + 1, top + 1);
    }
    return shape;
}

Shape gem(double radius, double half_height, unsigned sides) {
    Shape shape{{{0, half_height, 0}, {0, -half_height, 0}}, {}};
    for (unsigned i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        shape.vertices.emplace_back(radius * std::cos(angle), 0, radius * std::sin(angle));
        const unsigned here = 2 + i;
        const unsigned next = 2 + (i + 1) % sides;
        shape.triangles.emplace_back(0, next, here);
        shape.triangles.emplace_back(1, here, next);
    }
    return shape;
}

Shape welded(const Shape& shape) {
    Shape result;
    Welder welder(result);
    for (const glm::uvec3& triangle : shape.triangles)
        result.triangles.emplace_back(welder.vertex(shape.vertices[triangle.x]),
                                      welder.vertex(shape.vertices[triangle.y]),
                                      welder.vertex(shape.vertices[triangle.z]));
    return result;
}

} // namespace shadowproof::author
