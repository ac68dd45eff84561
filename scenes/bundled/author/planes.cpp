#include "scenes/bundled/author/parts.h"

#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof::author {

namespace {

// Kilgard's capping (2001) tells three cases apart by how many vertices of an occluder the light
// projects onto the near plane. The centre of the near plane of looking_along_floor() lies at
// (1.251, 4.909, 11.784), and its half height is 0.289.

/// A still life, on which errors at the near plane show.
void add_still_life(Stage& stage) {
    add(stage, {{.name = "bowl",
                 .shape = torus(0.787, 0.341, 64, 24),
                 .color = teal,
                 .position = {1.413, 0.373, 0.817},
                 .turn_axis = {1, 0, 0},
                 .turn = 0.0213},
                {.name = "apple",
                 .shape = ball(0.613, 3),
                 .color = coral,
                 .position = {1.431, 0.913, 0.797},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331},
                {.name = "book",
                 .shape = box({0.913, 0.171, 0.613}, 4),
                 .color = slate,
                 .position = {-1.357, 0.203, 1.239},
                 .turn = 0.4371},
                {.name = "bottle",
                 .shape = disc(0.387, 1.113, 32),
                 .color = amber,
                 .position = {-0.871, 1.137, -1.413},
                 .turn = 0.171}});
}

Stage near_cap_all() {
    Stage stage = looking_along_floor("near_cap_all",
                                      "A small ring hangs before the light; the shadow of all of "
                                      "it falls on the near plane.",
                                      {"near_plane"});
    add_still_life(stage);
    add(stage, {{.name = "ring",
                 .shape = torus(0.113, 0.037, 48, 16),
                 .color = coral,
                 .position = {0.291, 5.713, 9.273},
                 .turn_axis = {0.9, 0.1, -0.2},
                 .turn = 1.3713}});
    return stage;
}

Stage near_cap_some() {
    Stage stage = looking_along_floor("near_cap_some",
                                      "A rod above the picture runs through the near plane to "
                                      "the eye's side; only one end throws its shadow there.",
                                      {"near_plane"});
    add_still_life(stage);
    add(stage, {rod("rod", {0.317, 5.591, 9.173}, {1.271, 5.613, 11.927}, 0.0613, slate)});
    return stage;
}

Stage near_cap_none() {
    Stage stage = looking_along_floor("near_cap_none",
                                      "A ring around the eye lies wholly behind the near plane, "
                                      "where no shadow of it falls.");
    add_still_life(stage);
    const glm::dvec3 ahead = glm::normalize(stage.target - stage.eye);
    add(stage, {{.name = "halo",
                 .shape = torus(0.613, 0.087, 64, 16),
                 .color = coral,
                 .position = stage.eye + 0.313 * ahead,
                 .turn_axis = {0.997, 0.013, -0.101},
                 .turn = 1.1713}});
    return stage;
}

/// A tetrahedron, wound outwards whatever the order of its corners.
Shape tetrahedron(const glm::dvec3& a, const glm::dvec3& b, glm::dvec3 c, glm::dvec3 d) {
    if (glm::dot(glm::cross(b - a, c - a), d - a) > 0) std::swap(c, d);
    return {{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

/// The eye is exactly light + 1/2 (a - light) + 3/4 (b - light), where a b is a silhouette edge of
/// the shard as the light sees it. So it lies on the side extruded from this edge, which is seen as
/// a line through the middle of the picture. Whether the eye is inside is a tie: both causes are
/// right.
Stage eye_on_side() {
    Stage stage = looking_along_floor("eye_on_side",
                                      "The eye lies exactly on a side of a shadow volume, and "
                                      "half of the near plane inside.",
                                      {"near_plane", "eye_inside"});
    add_still_life(stage);
    constexpr glm::dvec3 light{-3.5, 8.875, -0.75};
    constexpr glm::dvec3 a{0.875, 4.875, 10.4375};
    constexpr glm::dvec3 b{0.0625, 6.625, 9.65625};
    stage.light.position = light;
    stage.eye = 0.5 * a + 0.75 * b - 0.25 * light;
    add(stage,
        {{.name = "shard",
          .shape = tetrahedron(a, b, {1.5625, 5.328125, 10.046875}, {1.015625, 6.53125, 9.25}),
          .color = coral}});
    return stage;
}

/// The plank is behind and above the picture. Its shadow reaches from the eye to the floor in the
/// picture, and goes down too steeply to be seen far away.
Stage seen_shadow() {
    Stage stage = looking_along_floor("seen_shadow",
                                      "A plank shades the eye and a strip of the floor that it "
                                      "sees: its volume is needed, and begins around the eye.",
                                      {"eye_inside"});
    stage.light.position = {1.213, 14.013, 9.071};
    stage.znear = 0.313;
    stage.zfar = 171.3; // beyond the floor's own shadow, which rays under its rim run through
    add_still_life(stage);
    add(stage, {{.name = "plank",
                 .shape = box({0.263, 0.087, 3.213}, 4),
                 .color = slate,
                 .position = {1.271, 8.013, 9.113},
                 .turn = 0.0171}});
    return stage;
}

/// Only bodies in space: a ray is in shadow at the far plane only where the plane lies inside a
/// body, or in the shadow of one.
Stage far_cut() {
    Stage stage = looking_along_floor("far_cut",
                                      "The far plane cuts a planet and its belt in two; where "
                                      "rays end inside the planet, its front is lit all the same.",
                                      {"far_plane"});
    stage.things.clear();
    add(stage, {{.name = "planet",
                 .shape = ball(2.113, 4),
                 .color = amber,
                 .position = {-0.171, -0.113, 0.117},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.7331},
                {.name = "belt",
                 .shape = torus(3.217, 0.247, 96, 20),
                 .color = teal,
                 .position = {-0.171, -0.113, 0.117},
                 .turn_axis = {0.713, 0.071, -0.602},
                 .turn = 0.4713},
                {.name = "moon",
                 .shape = ball(0.487, 3),
                 .color = slate,
                 .position = {-1.813, 2.471, 1.613},
                 .turn_axis = {0.31, 0.83, 0.47},
                 .turn = 0.3331}});
    stage.light.position = {-6.471, 7.877, 4.683};
    stage.zfar = 14.713;
    return stage;
}

} // namespace

std::vector<Stage> stages_of_planes() {
    return {near_cap_all(), near_cap_some(), near_cap_none(),
            eye_on_side(),  seen_shadow(),   far_cut()};
}

} // namespace shadowproof::author
