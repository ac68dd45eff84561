#include "scenes/bundled/author/parts.h"
#include "scenes/bundled/author/textures.h"

#include <string>
#include <utility>

namespace shadowproof::author {

namespace {

/// The sphere has no tangents of its own: they are made by MikkTSpace's rule.
Stage bumpy_sphere() {
    Stage stage = lit_from_the_left(
        "bumpy_sphere", "A sphere with round bumps by a normal map, without tangents of its own.");
    stage.textures = {{"bumps", png_of(normal_map(64, 64, bumps(2, 2), 7))}};
    add(stage, {{.name = "sphere",
                 .shape = textured_ball(glm::dvec3(1.713), 48, 24, Wearing::around, {6, 3}),
                 .color = teal,
                 .position = {0.113, 1.741, 0.171},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331,
                 .look = {.bump = 0, .specular = glm::dvec3(0.7)}}});
    return stage;
}

/// Kilgard's doughnut: bumps, and a decal whose alpha is the gloss.
Stage bumpy_torus() {
    Stage stage = lit_from_the_left(
        "bumpy_torus",
        "A torus with tangents, a normal map, and a decal that is glossy on the bumps alone.");
    stage.textures = {{"bumps", png_of(normal_map(64, 64, bumps(2, 2), 9))},
                      {"stripes", png_of(glossy_stripes(64, 64, bumps(2, 2), {0.93, 0.79, 0.42},
                                                        {0.55, 0.17, 0.21}))}};
    add(stage, {{.name = "torus",
                 .shape = textured_torus(1.487, 0.613, 56, 28, {8, 4}),
                 .color = {0.95, 0.95, 0.95},
                 .position = {0.091, 1.367, 0.143},
                 .turn_axis = {0.913, 0.071, 0.402},
                 .turn = 0.6713,
                 .look = {.bump = 0,
                          .decal = 1,
                          .gloss_in_alpha = true,
                          .specular = glm::dvec3(0.9, 0.85, 0.8)}}});
    return stage;
}

/// Half a picture for a whole face, as skins of characters save texels: the other half is its
/// mirror image, and tangents differ where the halves meet.
Stage mirrored_skin() {
    Stage stage = lit_from_the_left(
        "mirrored_skin", "Both halves of a head wear one picture, the other half mirrored.");
    stage.textures = {{"hook", png_of(normal_map(64, 64, hook(), 6))}};
    add(stage, {{.name = "head",
                 .shape = textured_ball({1.313, 1.787, 1.413}, 24, 16, Wearing::mirrored, {2, 2}),
                 .color = amber,
                 .position = {0.113, 1.811, 0.171},
                 .turn = 0.0713,
                 .look = {.bump = 0, .specular = glm::dvec3(0.5)}}});
    return stage;
}

/// A height field of 16 bits, mirrored again and again over the faces of a slab.
Stage height_field() {
    Stage stage = lit_from_the_left(
        "height_field", "A slab whose bumps are a height field instead of a normal map.");
    stage.textures = {{"ripples", png_of(height_map(64, 64, ripples())), wrap_mirrored_repeat}};
    add(stage,
        {{.name = "slab",
          .shape = textured_box({1.613, 1.413, 0.413}, 3),
          .color = coral,
          .position = {0.113, 1.571, 0.171},
          .turn_axis = {-0.871, 0.131, 0.073},
          .turn = 0.3713,
          .look = {
              .bump = 0, .bump_is_height = true, .bump_scale = 11, .specular = glm::dvec3(0.6)}}});
    return stage;
}

/// A relief whose heights are in the file's units, on a beam four times as long as thick.
Placed beam(Shape shape) {
    return {.name = "beam",
            .shape = std::move(shape),
            .color = amber,
            .position = {0.113, 1.371, 0.171},
            .turn_axis = {-0.291, 0.831, 0.173},
            .turn = 0.5713,
            .look = {.bump = 0,
                     .bump_is_height = true,
                     .bump_scale = 0.11,
                     .height_in_space = true,
                     .specular = glm::dvec3(0.6)}};
}

/// Once around each face, so that texels are squares at the ends of the beam alone.
Stage stretched_relief() {
    Stage stage = lit_from_the_left(
        "stretched_relief", "A relief of heights in the file's units, stretched four to one "
                            "over the long faces of a beam.");
    stage.provokes = {"shading"};
    stage.textures = {{"ripples", png_of(height_map(64, 64, ripples()))}};
    add(stage, {beam(textured_box({2.052, 0.513, 0.513}, 3))});
    return stage;
}

/// Rows that lean: the texture's two directions are not at right angles on the beam.
Stage skewed_relief() {
    Stage stage = lit_from_the_left("skewed_relief",
                                    "A relief of heights in the file's units, whose texels are "
                                    "parallelograms on the faces of a beam.");
    stage.provokes = {"shading"};
    stage.textures = {{"ripples", png_of(height_map(64, 64, ripples()))}};
    Shape leaning = textured_box({2.052, 0.513, 0.513}, 3);
    for (glm::dvec2& at : leaning.coordinates) at = {4 * at.x + at.y, at.y};
    add(stage, {beam(std::move(leaning))});
    return stage;
}

/// A ball through a ring, both hammered: silver, with stripes of gold that are dull in the dents.
Stage hammered_silver() {
    Stage stage = lit_from_the_left(
        "hammered_silver", "A hammered ball and a ring around it reflect sky, plain and windows.");
    stage.textures = {{"dents", png_of(normal_map(64, 64, bumps(2, 2), 2.3))},
                      {"stripes", png_of(glossy_stripes(64, 64, bumps(2, 2), {0.87, 0.69, 0.31},
                                                        {0.47, 0.29, 0.17}))}};
    for (unsigned face = 0; face < 6; ++face) {
        stage.environment.push_back(stage.textures.size());
        stage.textures.push_back({"surroundings " + std::to_string(face),
                                  png_of(surroundings(face, 64)), wrap_clamp_to_edge});
    }
    const glm::dvec3 place{0.113, 1.253, 0.171};
    add(stage, {{.name = "ball",
                 .shape = textured_ball(glm::dvec3(1.213), 48, 24, Wearing::around, {6, 3}),
                 .color = {0.13, 0.13, 0.14},
                 .position = place,
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331,
                 .look = {.bump = 0,
                          .specular = glm::dvec3(0.4),
                          .reflectance = glm::dvec3(0.67, 0.68, 0.70)}},
                {.name = "ring",
                 .shape = textured_torus(1.613, 0.213, 48, 16, {10, 2}),
                 .color = {0.4, 0.4, 0.4},
                 .position = place,
                 .turn_axis = {0.913, 0.071, 0.402},
                 .turn = 0.3713,
                 .look = {.bump = 0,
                          .decal = 1,
                          .gloss_in_alpha = true,
                          .specular = glm::dvec3(0.7, 0.6, 0.4),
                          .reflectance = glm::dvec3(0.71, 0.55, 0.29)}}});
    return stage;
}

} // namespace

std::vector<Stage> stages_of_bumps() {
    return {bumpy_sphere(),     bumpy_torus(),   mirrored_skin(),  height_field(),
            stretched_relief(), skewed_relief(), hammered_silver()};
}

} // namespace shadowproof::author
