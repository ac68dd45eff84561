// Scenes so small that every count in them is known by hand.
#pragma once

#include "scenes/scene.h"

namespace shadowproof::tests {

/// A scene of one single-sided material without triangles: 64x64 pixels, the eye at (0, 0, 5)
/// looking down -z with a 90 degree field of view, near 0.1, no far plane, a point light at
/// (0, 0, 5).
Scene empty_scene();

/// Appends a mesh: the closed box, outside in front.
void add_box(Scene& scene, const glm::vec3& low, const glm::vec3& high);

/// Appends a mesh of one rectangle a, b, c, d, counter-clockwise from the front.
void add_rectangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                   const glm::vec3& d);

/// A camera at `eye` that looks at `target`, up as near +y as can be.
void look_at(Camera& camera, const glm::dvec3& eye, const glm::dvec3& target);

/// Two-sided floor y = 0 over [-10, 10]^2, a closed box over it ([-1, 1] x [1, 2] x [-1, 1]), the
/// light 4 above the box's centre line, at (0, 6, 0): the shadow on the floor is the square of half
/// width 1 * 6 / 5 cast by the box's lower edges or, wider, 1 * 6 / 4 = 1.5 by its upper ones. Eye
/// at (4, 6, 7), 128x128 pixels.
Scene box_over_floor();

/// The pixel that shows a world point.
struct Pixel {
    int x = 0;
    int y = 0;
};
Pixel pixel_of(const Scene& scene, const glm::dvec3& point);

} // namespace shadowproof::tests
