#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/textures.h"

#include <cmath>
#include <numbers>
#include <string>

namespace shadowproof::author {

namespace {

/// looking_along_floor, with bumps to wear and some light in the shadows.
Stage with_bumps(std::string name, std::string title, std::vector<std::string> provokes) {
    Stage stage = looking_along_floor(std::move(name), std::move(title), std::move(provokes));
    stage.ambient = {0.11, 0.12, 0.14};
    stage.things[0].look.specular = glm::dvec3(0);
    stage.textures = {{"bumps", png_of(normal_map(64, 64, bumps(2, 2), 7))}};
    return stage;
}

const Look bumpy{.bump = 0, .specular = glm::dvec3(0.7)};

/// near_plane with bumps: where the ring's shadow crosses the near plane, z-pass takes lit bumps
/// for dark ones and dark ones for lit.
Stage bumpy_near_plane() {
    Stage stage = with_bumps("bumpy_near_plane",
                             "Bumps are lit behind a near plane that the shadow of a ring off the "
                             "picture crosses.",
                             {"near_plane"});
    add(stage, {{.name = "planet",
                 .shape = textured_ball({1.213, 1.213, 1.213}, 40, 24, Wearing::around, {8, 4}),
                 .color = amber,
                 .position = {-0.371, 1.493, 0.117},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331,
                 .look = bumpy},
                {.name = "belt",
                 .shape = textured_torus(1.817, 0.147, 64, 14, {24, 2}),
                 .color = teal,
                 .position = {-0.371, 1.493, 0.117},
                 .turn_axis = {0.913, 0.071, -0.402},
                 .turn = 0.3713,
                 .look = bumpy},
                {.name = "box",
                 .shape = textured_box({0.513, 0.513, 0.513}, 3),
                 .color = slate,
                 .position = {2.571, 0.541, 1.093},
                 .turn = 0.9371,
                 .look = bumpy},
                {.name = "ring",
                 .shape = torus(0.153, 0.063, 64, 24),
                 .color = coral,
                 .position = {0.219, 5.687, 9.027},
                 .turn_axis = {0.9, 0.1, -0.2},
                 .turn = 1.3713}});
    return stage;
}

/// far_plane with bumps: what the far plane cuts off the volumes leaves bumps lit that are in
/// shadow, and dark where a volume's end is lost.
Stage bumpy_far_plane() {
    Stage stage = with_bumps("bumpy_far_plane",
                             "Bumps are lit before a far plane through which shadows run out.",
                             {"far_plane", "cap"});
    constexpr int stones = 5;
    for (int i = 0; i < stones; ++i) {
        const double angle = 0.413 + 0.587 * i; // radians, an arc open to the eye
        const double height = 0.613 + 0.171 * ((i * 2) % stones);
        add(stage,
            {{.name = "stone " + std::to_string(i + 1),
              .shape = textured_box({0.413, height, 0.257}, 3),
              .color = slate,
              .position = {3.013 * std::cos(angle), height + 0.031, -2.913 * std::sin(angle) + 0.4},
              .turn = angle + std::numbers::pi / 2 + 0.071,
              .look = bumpy}});
    }
    add(stage, {{.name = "ball",
                 .shape = textured_ball({0.917, 0.917, 0.917}, 32, 20, Wearing::around, {6, 3}),
                 .color = coral,
                 .position = {-0.213, 0.949, 0.671},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331,
                 .look = bumpy}});
    stage.zfar = 20.3;
    stage.light.position = {-2.971, 5.477, 8.383};
    return stage;
}

/// eye_inside with bumps: counted from the eye as if that stood in the light, the whole picture is
/// lit as shadow is, and shadow as light.
Stage bumpy_eye_inside() {
    Stage stage = with_bumps("bumpy_eye_inside",
                             "The eye stands in the shadow of a canopy and looks at bumps in the "
                             "light.",
                             {"eye_inside"});
    add(stage, {{.name = "torus",
                 .shape = textured_torus(1.187, 0.413, 48, 20, {12, 4}),
                 .color = amber,
                 .position = {-0.809, 0.447, 0.343},
                 .turn_axis = {1, 0, 0},
                 .turn = 0.0213,
                 .look = bumpy},
                {.name = "ball",
                 .shape = textured_ball({0.713, 0.713, 0.713}, 28, 18, Wearing::around, {6, 3}),
                 .color = coral,
                 .position = {-0.793, 0.957, 0.371},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331,
                 .look = bumpy},
                {.name = "block",
                 .shape = textured_box({0.413, 1.217, 0.413}, 3),
                 .color = teal,
                 .position = {2.013, 1.241, -0.871},
                 .turn = 0.171,
                 .look = bumpy},
                {.name = "canopy",
                 .shape = disc(1.013, 0.087, 72),
                 .color = slate,
                 .position = {0.267, 6.213, 9.571},
                 .turn_axis = {0.9, 0.1, -0.2},
                 .turn = 0.713}});
    stage.znear = 0.313;
    return stage;
}

/// Two lights whose shadows cross: each surface is in none, in one or in both, and the spot's light
/// is added to the key's.
Stage bumpy_lights() {
    Stage stage = lit_from_the_left("bumpy_lights",
                                    "Bumps under two lights, whose light is added up and whose "
                                    "shadows cross.");
    stage.textures = {{"bumps", png_of(normal_map(64, 64, bumps(2, 2), 7))},
                      {"stripes", png_of(glossy_stripes(64, 64, bumps(2, 2), {0.93, 0.79, 0.42},
                                                        {0.55, 0.17, 0.21}))}};
    add(stage, {{.name = "torus",
                 .shape = textured_torus(1.187, 0.413, 48, 20, {12, 4}),
                 .color = {0.95, 0.95, 0.95},
                 .position = {-0.409, 0.447, 0.343},
                 .turn_axis = {1, 0, 0},
                 .turn = 0.0213,
                 .look = {.bump = 0,
                          .decal = 1,
                          .gloss_in_alpha = true,
                          .specular = glm::dvec3(0.9, 0.85, 0.8)}},
                {.name = "ball",
                 .shape = textured_ball({0.713, 0.713, 0.713}, 28, 18, Wearing::around, {6, 3}),
                 .color = coral,
                 .position = {-0.393, 1.257, 0.371},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331,
                 .look = bumpy},
                {.name = "block",
                 .shape = textured_box({0.313, 0.917, 0.313}, 3),
                 .color = teal,
                 .position = {1.513, 0.941, -0.371},
                 .turn = 0.171,
                 .look = bumpy}});
    stage.target = {0.141, 0.641, 0.013};
    stage.yfov = 0.3637;
    stage.light.name = "key";
    stage.light.color = {0.71, 0.63, 0.51};
    stage.more_lights = {{.name = "spot",
                          .type = "spot",
                          .position = {4.171, 5.871, 5.313},
                          .target = {0.313, 0.571, 0.171},
                          .color = {0.37, 0.49, 0.67},
                          .intensity = 900,
                          .outer_cone = 0.2371,
                          .moves_to = {}}};
    return stage;
}

} // namespace

std::vector<Stage> stages_of_shadowed_bumps() {
    return {bumpy_near_plane(), bumpy_far_plane(), bumpy_eye_inside(), bumpy_lights()};
}

} // namespace shadowproof::author
