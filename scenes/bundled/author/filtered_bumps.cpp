#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/textures.h"

#include <cmath>
#include <glm/vec2.hpp>
#include <string>
#include <utility>

namespace shadowproof::author {

namespace {

/// A box whose faces repeat their texture so often, along and down.
Shape tiled_box(const glm::dvec3& half_size, const glm::dvec2& repeats) {
    Shape shape = textured_box(half_size, 1);
    for (glm::dvec2& at : shape.coordinates) at *= repeats;
    return shape;
}

/// What a pixel covers of a texture grows along a floor with the distance, and from board to board
/// by how often each repeats it: from a tenth of a texel to a hundred. The three rows of boards
/// lean back, each more than the one below. Behind the floor, which reaches far, volumes go on
/// through the far plane.
Stage distant_bumps() {
    Stage stage;
    stage.name = "distant_bumps";
    stage.title = "Bumps from ten pixels a texel to a hundred texels a pixel, upright and slanted; "
                  "the file asks for mipmaps.";
    stage.provokes = {"far_plane", "shading"};
    stage.ambient = {0.05, 0.055, 0.065};
    stage.textures = {
        {"bumps", png_of(normal_map(64, 64, bumps(8, 8), 2.3)), wrap_repeat, true},
        {"grooves", png_of(height_map(64, 64, grooves(16))), wrap_repeat, true},
        {"stripes",
         png_of(glossy_stripes(64, 64, bumps(8, 8), {0.87, 0.81, 0.69}, {0.49, 0.37, 0.31})),
         wrap_repeat, true}};
    const Look bumpy{.bump = 0, .decal = 2, .specular = glm::dvec3(0.6)};
    const Look grooved{
        .bump = 1, .bump_is_height = true, .bump_scale = 1.7, .specular = glm::dvec3(0.5)};
    add(stage, {{.name = "floor",
                 .shape = tiled_box({17.13, 0.171, 29.07}, {14.3, 24.3}),
                 .color = {0.95, 0.95, 0.95},
                 .position = {0.113, -0.171, -20.873},
                 .look = bumpy}});
    constexpr int columns = 7;
    constexpr int rows = 3;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            // From 0.1 to 100 texels a pixel, were the board upright: 64 texels, and 47 pixels.
            const double repeats = 0.1 * std::pow(10.0, 0.5 * column) * 47 / 64;
            add(stage, {{.name = "board " + std::to_string(columns * row + column + 1),
                         .shape = tiled_box({0.391, 0.391, 0.053}, {repeats, repeats}),
                         .color = teal,
                         .position = {-2.813 + 0.971 * column, 2.513 + 0.971 * row, 0.713},
                         .turn_axis = {-1, 0, 0},
                         .turn = 0.213 + 0.487 * row,
                         .look = column % 2 == row % 2 ? bumpy : grooved}});
        }
    add(stage, {{.name = "ball",
                 .shape = textured_ball(glm::dvec3(0.613), 32, 20, Wearing::around, {4, 2}),
                 .color = coral,
                 .position = {-1.313, 0.641, 3.171},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331,
                 .look = {.bump = 0, .specular = glm::dvec3(0.7)}},
                {.name = "post",
                 .shape = tiled_box({0.213, 1.413, 0.213}, {2, 13}),
                 .color = amber,
                 .position = {2.371, 1.441, -4.571},
                 .turn = 0.371,
                 .look = grooved}});
    stage.eye = {0.071, 1.713, 10.313};
    stage.target = {0.071, 1.513, 0};
    stage.yfov = 0.8371;
    stage.znear = 0.5;
    stage.zfar = 100;
    stage.light.position = {-5.371, 17.313, 9.713};
    stage.light.color = {0.81, 0.79, 0.73};
    return stage;
}

} // namespace

std::vector<Stage> stages_of_filtered_bumps() {
    return {distant_bumps()};
}

} // namespace shadowproof::author
