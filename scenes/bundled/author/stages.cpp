#include "scenes/bundled/author/stages.h"

#include <numbers>

namespace shadowproof::author {

namespace {

// Positions and angles are odd on purpose: no edge, ray or face lies on a grid line of another.

constexpr glm::dvec3 sand{0.72, 0.66, 0.55};
constexpr glm::dvec3 coral{0.85, 0.29, 0.20};
constexpr glm::dvec3 teal{0.10, 0.46, 0.48};
constexpr glm::dvec3 amber{0.90, 0.60, 0.13};
constexpr glm::dvec3 slate{0.28, 0.32, 0.40};

/// A round slab whose top is at height 0.
Placed floor(double radius) {
    constexpr double half_height = 0.11;
    return {"floor", disc(radius, half_height, 120), sand, {0.013, -half_height, -0.021}, {0, 1, 0},
            0.0171};
}

/// The light stands high over a small floor, and the eye looks along it rather than down: every
/// ray leaves the cone of the shadows again before the far plane, and none points into it.
Stage ordinary() {
    Stage stage;
    stage.name = "ordinary";
    stage.title = "A box, a torus and a ball on a floor, all closed; no technique fails here.";
    stage.things = {
        floor(4.43),
        {"box", box({0.83, 0.83, 0.83}, 6), slate, {-1.637, 0.861, -0.893}, {0, 1, 0}, 0.5371},
        {"torus",
         torus(0.787, 0.313, 88, 32),
         coral,
         {-0.109, 0.967, 1.243},
         {0.913, 0.071, 0.402},
         1.1713},
        {"ball", ball(0.917, 4), teal, {1.753, 0.949, -0.571}, {0.31, 0.83, 0.47}, 0.7331},
    };
    stage.eye = {1.237, 4.873, 11.317};
    stage.target = {0.041, 0.387, 0.013};
    stage.yfov = 0.6137;
    stage.znear = 0.913;
    stage.zfar = 71.3;
    stage.light = {-2.171, 9.377, 2.383};
    return stage;
}

/// A ring hangs above the eye, outside the picture. Its shadow falls steeply past the near plane
/// onto the floor; the eye itself stays in the light.
Stage near_plane() {
    Stage stage = ordinary();
    stage.name = "near_plane";
    stage.title = "The shadow of a ring overhead passes through a part of the near plane.";
    stage.provokes = {"near_plane"};
    return stage;
}

Stage far_plane() {
    Stage stage = ordinary();
    stage.name = "far_plane";
    stage.title = "Shadows run out through the far plane behind surfaces that are lit.";
    stage.provokes = {"far_plane"};
    return stage;
}

Stage eye_inside() {
    Stage stage = ordinary();
    stage.name = "eye_inside";
    stage.title = "The eye stands in the shadow of a canopy and looks out into the light.";
    stage.provokes = {"eye_inside"};
    return stage;
}

} // namespace

std::vector<Stage> all_stages() {
    return {ordinary(), near_plane(), far_plane(), eye_inside()};
}

} // namespace shadowproof::author
