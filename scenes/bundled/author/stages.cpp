#include "scenes/bundled/author/stages.h"

#include "scenes/bundled/author/parts.h"

#include <cmath>
#include <numbers>
#include <string>

namespace shadowproof::author {

namespace {

Stage ordinary() {
    Stage stage = looking_along_floor(
        "ordinary", "A box, a torus and a ball on a floor, all closed; no technique fails here.");
    add(stage,
        {{"box", box({0.83, 0.83, 0.83}, 6), slate, {-1.637, 0.861, -0.893}, {0, 1, 0}, 0.5371},
         {"torus",
          torus(0.787, 0.313, 88, 32),
          coral,
          {-0.109, 0.967, 1.243},
          {0.913, 0.071, 0.402},
          1.1713},
         {"ball", ball(0.917, 4), teal, {1.753, 0.949, -0.571}, {0.31, 0.83, 0.47}, 0.7331}});
    return stage;
}

/// A ring hangs outside the picture, between the light and the near plane. Its shadow crosses the
/// near plane at a slant and misses the eye.
Stage near_plane() {
    Stage stage = looking_along_floor(
        "near_plane", "The shadow of a ring off the picture crosses a part of the near plane.",
        {"near_plane"});
    add(stage,
        {{"planet", ball(1.213, 4), amber, {-0.371, 1.493, 0.117}, {0.31, 0.83, 0.47}, 0.7331},
         {"belt",
          torus(1.817, 0.147, 96, 20),
          teal,
          {-0.371, 1.493, 0.117},
          {0.913, 0.071, -0.402},
          0.3713},
         {"box", box({0.513, 0.513, 0.513}, 5), slate, {2.571, 0.541, 1.093}, {0, 1, 0}, 0.9371},
         {"ring",
          torus(0.153, 0.063, 64, 24),
          coral,
          {0.219, 5.687, 9.027},
          {0.9, 0.1, -0.2},
          1.3713}});
    return stage;
}

/// The far plane lies close behind the floor: rays that go through the near half of the floor are
/// still in its shadow there, rays that graze the far half have left it.
Stage far_plane() {
    Stage stage = looking_along_floor(
        "far_plane", "Shadows run out through the far plane behind surfaces that are lit.",
        {"far_plane", "cap"});
    constexpr int stones = 5;
    for (int i = 0; i < stones; ++i) {
        const double angle = 0.413 + 0.587 * i; // radians, an arc open to the eye
        const double height = 0.613 + 0.171 * ((i * 2) % stones);
        add(stage, {{"stone " + std::to_string(i + 1),
                     box({0.413, height, 0.257}, 4),
                     slate,
                     {3.013 * std::cos(angle), height + 0.031, -2.913 * std::sin(angle) + 0.4},
                     {0, 1, 0},
                     angle + std::numbers::pi / 2 + 0.071}});
    }
    add(stage,
        {{"ball", ball(0.917, 4), coral, {-0.213, 0.949, 0.671}, {0.31, 0.83, 0.47}, 0.7331}});
    stage.zfar = 20.3;
    stage.light.position = {-2.971, 5.477, 8.383};
    return stage;
}

/// A canopy shadows the eye and the whole near plane, and nothing that is seen.
Stage eye_inside() {
    Stage stage = looking_along_floor(
        "eye_inside", "The eye stands in the shadow of a canopy and looks out into the light.",
        {"eye_inside"});
    add(stage,
        {{"torus", torus(1.187, 0.413, 88, 32), amber, {-0.809, 0.447, 0.343}, {1, 0, 0}, 0.0213},
         {"ball", ball(0.713, 4), coral, {-0.793, 0.957, 0.371}, {0.31, 0.83, 0.47}, 0.7331},
         {"pillar", disc(0.463, 1.217, 48), teal, {2.013, 1.241, -0.871}, {0, 1, 0}, 0.171},
         {"canopy",
          disc(1.013, 0.087, 72),
          slate,
          {0.267, 6.213, 9.571},
          {0.9, 0.1, -0.2},
          0.713}});
    stage.znear = 0.313;
    return stage;
}

} // namespace

std::vector<Stage> all_stages() {
    std::vector<Stage> stages{ordinary(), near_plane(), far_plane(), eye_inside()};
    for (const auto& more :
         {stages_of_planes(), stages_of_lights(), stages_of_casters(), stages_of_bumps(),
          stages_of_glare(), stages_of_shadowed_bumps(), stages_of_filtered_bumps(),
          stages_of_figures(), stages_of_maps(), stages_of_rays(), stages_of_masks()})
        stages.insert(stages.end(), more.begin(), more.end());
    return stages;
}

} // namespace shadowproof::author
