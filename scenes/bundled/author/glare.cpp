#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/textures.h"

#include <cmath>
#include <string>

namespace shadowproof::author {

namespace {

/// Normals rotate by a sixth of a circle within a triangle: interpolated without renormalising, or
/// normalised at the vertices alone, they light it wrongly. The rim of the cone runs across it.
Stage coarse_curve() {
    Stage stage = lit_from_the_left(
        "coarse_curve",
        "A capsule of few triangles with smooth normals and a normal map, half in a spot light.");
    stage.light.name = "spot";
    stage.light.type = "spot";
    stage.light.target = {-0.713, 1.713, 0.213};
    stage.light.outer_cone = 0.1831;
    stage.textures = {{"bumps", png_of(normal_map(64, 64, bumps(2, 2), 6))}};
    add(stage, {{.name = "capsule",
                 .shape = textured_lathe(capsule(1.213, 0.613, 2), 1, 6, Wearing::around, {6, 4}),
                 .color = coral,
                 .position = {0.113, 1.871, 0.171},
                 .turn_axis = {0.071, 0.213, 0.971},
                 .turn = 0.7731,
                 .look = {.bump = 0, .specular = glm::dvec3(0.8)}}});
    return stage;
}

/// Gentle waves, at most so steep that the sun sets on the far side of each.
glm::dvec3 swells(double x, double z) {
    constexpr glm::dvec2 long_wave(1.13, 0.37); // radians per unit
    constexpr glm::dvec2 short_wave(0.71, -1.67);
    constexpr double high = 0.051;
    constexpr double low = 0.029;
    const double a = long_wave.x * x + long_wave.y * z;
    const double b = short_wave.x * x + short_wave.y * z;
    const glm::dvec2 slope = high * std::cos(a) * long_wave + low * std::cos(b) * short_wave;
    return {high * std::sin(a) + low * std::sin(b), slope.x, slope.y};
}

/// The sun stands so low that selfShadow(L) = 8 L . N is below 1 nearly everywhere. The bumps end
/// at the border of their picture, whose outermost texels continue beyond it.
Stage grazing_light() {
    Stage stage = lit_from_the_left("grazing_light",
                                    "The sun grazes a bumpy ground with gentle swells, and stones "
                                    "throw long shadows over it.");
    stage.may_provoke = {"extrusion"}; // a wide picture shows the ends of the shadows
    stage.light.name = "sun";
    stage.light.type = "directional";
    stage.light.color = {1, 0.93, 0.81};
    stage.light.intensity = 30; // lux
    stage.light.position = {-53.71, 5.413, 12.13};
    stage.light.target = {0, 0, 0};
    stage.eye = {1.337, 7.273, 11.617};
    stage.yfov = 0.4737;
    stage.target = {0.041, -0.241, 0.213};
    stage.textures = {
        {"bumps", png_of(normal_map(96, 96, bumps(12, 12), 2.3)), wrap_clamp_to_edge}};
    stage.things = {{.name = "ground",
                     .shape = textured_ground({3.913, 0.313, 3.413}, 18, swells, 0.063),
                     .color = sand,
                     .position = {0.013, -0.313, -0.021},
                     .turn = 0.0713,
                     .look = {.bump = 0, .specular = glm::dvec3(0.35)}}};
    const glm::dvec3 stones[]{{-2.113, 0.213, -1.471},
                              {-1.613, 0.371, 1.313},
                              {0.413, 0.313, -0.313},
                              {1.713, 0.171, 1.871},
                              {2.213, 0.413, -1.913}};
    for (const glm::dvec3& stone : stones)
        add(stage, {{.name = "stone " + std::to_string(stage.things.size()),
                     .shape = textured_ball({stone.y, 1.3 * stone.y, stone.y}, 12, 8,
                                            Wearing::around, {2, 1}),
                     .color = slate,
                     .position = {stone.x, 0.9 * stone.y, stone.z},
                     .turn = 1.371 * stone.x,
                     .look = {.bump = 0, .specular = glm::dvec3(0.35)}}});
    return stage;
}

/// Light from the opposite side, as low as the eye: the half-angle vector stands upright, so H . N'
/// is near 1 where L . N is hardly above 0. selfShadow(L) dims these highlights; a technique that
/// multiplies by selfShadow(H) in its place leaves them bright.
Stage terminator_highlight() {
    Stage stage = lit_from_the_left("terminator_highlight",
                                    "Highlights where the light hardly reaches: it stands low "
                                    "behind glossy things.");
    stage.ambient = {0.07, 0.09, 0.13};
    stage.light.position = {-9.171, 2.813, -22.37};
    stage.light.color = {1, 0.89, 0.71};
    stage.eye = {1.337, 2.273, 9.617};
    stage.target = {-0.041, 0.013, 0.013};
    stage.yfov = 0.5537;
    stage.textures = {{"ripples", png_of(normal_map(64, 64, bumps(3, 3), 1.3))},
                      {"bumps", png_of(normal_map(64, 64, bumps(2, 2), 4))}};
    stage.things = {{.name = "water",
                     .shape = textured_ground({4.113, 0.213, 4.313}, 16, swells, 1.5),
                     .color = {0.16, 0.29, 0.37},
                     .position = {0.013, -0.313, -0.021},
                     .turn = 0.0713,
                     .look = {.bump = 0, .specular = glm::dvec3(0.57)}}};
    add(stage, {{.name = "buoy",
                 .shape = textured_ball({0.713, 0.713, 0.713}, 24, 16, Wearing::around, {8, 4}),
                 .color = coral,
                 .position = {-1.513, 0.413, 0.171},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331,
                 .look = {.bump = 1, .specular = glm::dvec3(0.9)}},
                {.name = "float",
                 .shape = textured_torus(0.613, 0.213, 28, 14, {8, 4}),
                 .color = amber,
                 .position = {1.171, 0.171, -0.513},
                 .turn_axis = {0.913, 0.071, 0.402},
                 .turn = 0.2713,
                 .look = {.bump = 1, .specular = glm::dvec3(0.9)}}});
    return stage;
}

/// About one texel per pixel, with every other one at another height: between two samples the
/// normal is a different one.
Stage fine_relief() {
    Stage stage = lit_from_the_left(
        "fine_relief", "A height field as fine as pixels, under a light that fades with distance.");
    stage.inverse_square = true;
    stage.light.intensity = 78; // candela; the light is some nine units away
    stage.textures = {{"gravel", png_of(height_map(128, 128, gravel(64)))}};
    Shape slab = textured_box({1.713, 1.213, 0.613}, 4);
    for (glm::dvec2& at : slab.coordinates) at *= 2.3;
    add(stage,
        {{.name = "slab",
          .shape = slab,
          .color = {0.63, 0.66, 0.71},
          .position = {0.113, 1.471, 0.171},
          .turn_axis = {-0.313, 0.871, 0.073},
          .turn = 0.5713,
          .look = {
              .bump = 0, .bump_is_height = true, .bump_scale = 1.3, .specular = glm::dvec3(0.4)}}});
    return stage;
}

/// Ambient and diffuse together exceed 1 before the decal reduces them again.
Stage bright_light() {
    Stage stage = lit_from_the_left("bright_light",
                                    "Ambient and diffuse light add up to more than 1, on decals "
                                    "that bring them back below.");
    stage.ambient = {0.57, 0.61, 0.67};
    stage.light.color = {1, 0.97, 0.91};
    stage.things[0].color = {0.47, 0.43, 0.36};
    stage.textures = {{"bumps", png_of(normal_map(64, 64, bumps(2, 2), 8))},
                      {"stripes", png_of(glossy_stripes(64, 64, bumps(2, 2), {0.71, 0.62, 0.43},
                                                        {0.35, 0.53, 0.61}))}};
    const Look look{.bump = 0, .decal = 1, .gloss_in_alpha = true, .specular = glm::dvec3(0.23)};
    add(stage, {{.name = "vase",
                 .shape = textured_lathe({{0, 1.613},
                                          {0.413, 1.571},
                                          {0.513, 1.413},
                                          {0.371, 1.171},
                                          {0.471, 0.871},
                                          {0.913, 0.413},
                                          {1.171, -0.213},
                                          {1.113, -0.813},
                                          {0.813, -1.313},
                                          {0.513, -1.571},
                                          {0, -1.613}},
                                         1, 28, Wearing::around, {6, 6}),
                 .color = {0.91, 0.91, 0.91},
                 .position = {-0.513, 1.671, -0.171},
                 .turn = 0.7331,
                 .look = look},
                {.name = "apple",
                 .shape = textured_ball({0.613, 0.571, 0.613}, 24, 16, Wearing::around, {4, 2}),
                 .color = {0.91, 0.91, 0.91},
                 .position = {1.413, 0.613, 0.813},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.3713,
                 .look = look}});
    return stage;
}

} // namespace

std::vector<Stage> stages_of_glare() {
    return {coarse_curve(), grazing_light(), terminator_highlight(), fine_relief(), bright_light()};
}

} // namespace shadowproof::author
