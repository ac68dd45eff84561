#include "scenes/bundled/author/parts.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace shadowproof::author {

namespace {

void append(Shape& shape, const Shape& more) {
    const auto first = static_cast<unsigned>(shape.vertices.size());
    shape.vertices.insert(shape.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const glm::uvec3& triangle : more.triangles) shape.triangles.push_back(triangle + first);
}

Shape scaled(Shape shape, double scale) {
    for (glm::dvec3& vertex : shape.vertices) vertex *= scale;
    return shape;
}

/// An 8-bit counter reads 0 in the second shell: 256 gems lie around it, and the other 44 inside.
Shape nested_gems(const Shape& gem) {
    Shape shape;
    constexpr int outer = 256;
    constexpr int inner = 44;
    for (int i = 0; i < outer; ++i) append(shape, scaled(gem, 1 - 0.25 * i / outer));
    for (int i = 0; i < inner; ++i) append(shape, scaled(gem, 0.43 - 0.19 * i / inner));
    return shape;
}

Stage nested() {
    Stage stage = looking_along_floor("nested",
                                      "Three hundred gems, one inside the other: where the "
                                      "shadow is 256 deep, a counter of 8 bits reads 0.",
                                      {"counter"});
    add(stage, {{.name = "gems",
                 .shape = nested_gems(gem(1.313, 1.587, 12)),
                 .color = coral,
                 .position = {-0.913, 2.271, 0.213},
                 .turn_axis = {0.871, 0.131, 0.473},
                 .turn = 0.3713}});
    return stage;
}

/// Three coins hang so that their shadows make a Venn diagram on the floor.
Stage overlapping() {
    Stage stage = looking_along_floor(
        "overlapping", "The shadows of three coins overlap by twos and by threes.", {"parity"});
    struct Coin {
        const char* name;
        glm::dvec3 color;
        glm::dvec3 shadow;
        double height;
    };
    const std::array<Coin, 3> coins{{{"copper", coral, {0.523, 0, 1.813}, 1.913},
                                     {"verdigris", teal, {1.793, 0, 1.413}, 2.471},
                                     {"gold", amber, {0.813, 0, 0.471}, 3.013}}};
    for (const auto& [name, color, shadow, height] : coins)
        add(stage, {{.name = name,
                     .shape = disc(0.813, 0.0613, 64),
                     .color = color,
                     .position = above(shadow, height, stage.light.position),
                     .turn_axis = {0.9, 0.1, -0.2},
                     .turn = 0.1713}});
    return stage;
}

/// Lanterns hang before and above the front rim of the floor, and the light stands behind it: their
/// shadows miss the floor, and each other.
Stage idle_casters() {
    Stage stage = looking_along_floor("idle_casters",
                                      "Lanterns whose shadows fall past the floor: their volumes "
                                      "cross the picture, and nothing seen is in them.");
    stage.light.position = {-0.471, 7.913, -9.113};
    add(stage, {{.name = "torus",
                 .shape = torus(0.787, 0.313, 32, 12),
                 .color = teal,
                 .position = {-0.713, 0.341, -0.471},
                 .turn_axis = {1, 0, 0},
                 .turn = 0.0213}});
    for (int i = 0; i < 36; ++i) {
        const int column = i % 9;
        const int row = i / 9;
        add(stage,
            {{.name = "lantern " + std::to_string(i + 1),
              .shape = gem(0.413, 0.471, 12),
              .color = i % 2 == 0 ? amber : coral,
              .position = {0.9713 * (column - 4) + 0.113, 1.871 + 1.013 * row, 4.113 + 0.213 * row},
              .turn_axis = {0.31, 0.83, 0.47},
              .turn = 0.3331 * i}});
    }
    return stage;
}

/// A shape without its highest plane.
Shape without_top(Shape shape) {
    double top = shape.vertices.front().y;
    for (const glm::dvec3& vertex : shape.vertices) top = std::max(top, vertex.y);
    const auto is_top = [&](unsigned vertex) { return shape.vertices[vertex].y == top; };
    std::erase_if(shape.triangles, [&](const glm::uvec3& triangle) {
        return is_top(triangle.x) && is_top(triangle.y) && is_top(triangle.z);
    });
    std::vector<unsigned> kept(shape.vertices.size(), 0);
    Shape open;
    for (const glm::uvec3& triangle : shape.triangles)
        for (int k = 0; k < 3; ++k) kept[triangle[k]] = 1;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i] == 0) continue;
        kept[i] = static_cast<unsigned>(open.vertices.size());
        open.vertices.push_back(shape.vertices[i]);
    }
    for (const glm::uvec3& triangle : shape.triangles)
        open.triangles.emplace_back(kept[triangle.x], kept[triangle.y], kept[triangle.z]);
    return open;
}

Stage open_lid() {
    Stage stage = looking_along_floor("open_lid",
                                      "Light falls into a box without a lid and onto its inner "
                                      "walls, whose shadows no volume of the outer ones holds.",
                                      {"open_mesh"});
    add(stage, {{.name = "open box",
                 .shape = without_top(box({1.213, 0.787, 0.913}, 4)),
                 .color = slate,
                 .position = {-0.613, 0.813, 0.571},
                 .turn = 0.4713,
                 .double_sided = true},
                {.name = "ball",
                 .shape = ball(0.471, 3),
                 .color = coral,
                 .position = {-0.571, 0.613, 0.613},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331},
                {.name = "lid",
                 .shape = box({1.213, 0.0613, 0.913}, 3),
                 .color = amber,
                 .position = {1.613, 0.0871, 1.971},
                 .turn = 0.2713}});
    return stage;
}

Shape inside_out(Shape shape) {
    for (glm::uvec3& triangle : shape.triangles) std::swap(triangle.y, triangle.z);
    return shape;
}

Stage inverted() {
    Stage stage = looking_along_floor("inverted",
                                      "A box wound inside out shows the inner sides of its far "
                                      "walls, and lights them through the near ones.",
                                      {"open_mesh"});
    add(stage, {{.name = "box inside out",
                 .shape = inside_out(box({0.987, 0.987, 0.987}, 4)),
                 .color = teal,
                 .position = {-0.871, 1.017, 0.271},
                 .turn = 0.6371},
                {.name = "ball",
                 .shape = ball(0.713, 3),
                 .color = coral,
                 .position = {1.871, 0.741, 0.971},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331}});
    return stage;
}

/// Boxes x, z in [-1, 0] and [0, 1] times the size: they meet in one upright edge, whose vertices
/// they share.
Shape boxes_at_an_edge(double size, double half_height, unsigned segments) {
    Shape shape;
    for (const double side : {-1.0, 1.0}) {
        Shape one = box({size / 2, half_height, size / 2}, segments);
        for (glm::dvec3& vertex : one.vertices) vertex += glm::dvec3(side, 0, side) * (size / 2);
        append(shape, one);
    }
    return welded(shape);
}

Stage non_manifold() {
    Stage stage = looking_along_floor("non_manifold",
                                      "Two boxes of one mesh share an edge of four triangles.");
    add(stage, {{.name = "twin boxes",
                 .shape = boxes_at_an_edge(1.375, 0.875, 3),
                 .color = slate,
                 .position = {-0.413, 0.913, 0.171},
                 .turn = 0.9371},
                {.name = "ball",
                 .shape = ball(0.613, 3),
                 .color = amber,
                 .position = {0.771, 0.641, 2.213},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331}});
    return stage;
}

/// The shape under the matrix of rows (3, 0, 1) / 4 and (-1, 0, 3) / 4 in x and z: a rotation and a
/// scale, which keeps it on a grid of 1/256 where it is on one of 1/64.
Shape turned_on_grid(Shape shape) {
    for (glm::dvec3& v : shape.vertices) v = {(3 * v.x + v.z) / 4, v.y, (3 * v.z - v.x) / 4};
    return shape;
}

/// Faces across x are one square, across y four by four, across z two by two: along each edge the
/// corners of one face lie within edges of the other, exactly, since all are on a grid.
Stage t_junctions() {
    Stage stage = looking_along_floor("t_junctions",
                                      "A box is closed to the eye, but the corners of one face "
                                      "lie within the edges of the next.");
    add(stage, {{.name = "patched box",
                 .shape = turned_on_grid(box({1.25, 0.875, 1.0}, {1, 4, 2})),
                 .color = slate,
                 .position = {-0.4375, 0.90625, 0.28125}},
                {.name = "torus",
                 .shape = torus(0.587, 0.213, 64, 24),
                 .color = coral,
                 .position = {1.971, 0.241, 1.571},
                 .turn_axis = {1, 0, 0},
                 .turn = 0.0213}});
    return stage;
}

} // namespace

std::vector<Stage> stages_of_casters() {
    return {nested(),   overlapping(),  idle_casters(), open_lid(),
            inverted(), non_manifold(), t_junctions()};
}

} // namespace shadowproof::author
