#include "compare/driver/error_bounds.h"

#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// Sum of the sizes of the terms that the float transform adds up for a point's view coordinate
/// along an axis of the camera. World coordinates carry the eye's distance from the origin with
/// them; eye-relative ones do not, but subtract the eye as two floats, which rounds twice.
double position_terms(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& axis,
                      const glm::dvec3& point) {
    const glm::dvec3& eye = scene.camera.eye;
    const auto terms = [&](const glm::dvec3& p) { return glm::dot(glm::abs(axis), glm::abs(p)); };
    return depth_model.eye_relative ? 2 * terms(point - eye) : terms(point) + terms(eye);
}

/// The same for the direction along which a point of a volume's side was extruded from the light.
double direction_terms(const Scene& scene, const glm::dvec3& axis, const glm::dvec3& point) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    return glm::dot(glm::abs(axis), glm::abs(light.w * point - glm::dvec3(light)));
}

/// View depth of `point`, at least the near plane's.
double depth_of(const Camera& camera, const glm::dvec3& point) {
    return std::max(view_depth(camera, point), camera.near);
}

} // namespace

// A matrix entry is rounded (1), multiplied (1) and added up (3): 5 v of the terms' sizes. In x
// that moves a point by scale / depth pixels a unit, in w by its own distance from the middle, at
// most half the picture, over the depth. The division, the viewport's product and its sum each
// round a coordinate of up to the picture's width: 3 v. Where lines of sight are parallel, w is 1,
// and no depth divides.
double lateral_error(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point) {
    const Camera& camera = scene.camera;
    const double half_step = half_snapping_step(depth_model.subpixel_bits);
    const double pixels = std::max(camera.width, camera.height);
    const double scale = 0.5 * camera.height / camera.half_height;
    const bool is_parallel = camera.is_orthographic();
    double terms = 0;
    for (const glm::dvec3& axis : {camera.right, camera.up})
        terms = std::max(terms, position_terms(scene, depth_model, axis, point) +
                                    direction_terms(scene, axis, point));
    if (!is_parallel)
        terms = std::max(terms, position_terms(scene, depth_model, camera.forward, point) +
                                    direction_terms(scene, camera.forward, point));
    const double moved = is_parallel ? scale : (scale + 0.5 * pixels) / depth_of(camera, point);
    const double transform = transform_roundings * v * moved * terms;
    return half_step + transform + 3 * v * pixels;
}

// Window depth z is rounded at 1/w, z/w, the viewport's sum (its product is by a power of two), and
// at the pixel in two products and two sums of its plane: 7 times by at most v z, where z = 1 is
// the largest standard depth and z = n/t the reversed one (where that is finite, a difference of
// terms whose sizes times dt/dz make t all the same). Storing it in fixed point rounds once
// more, by half a step: v / 2. In all less than 8 v z for a face, so `depth_roundings` for two that
// are compared, carried back to view depth by dt/dz. Parallel depth is linear: dt/dz is f - n, more
// where part of the range is reserved, and z at most 1.
double stored_depth_error(const DepthModel& depth_model, double depth) {
    const double near = depth_model.near;
    const double far = depth_model.far;
    double window_depth_error = depth * depth / near; // dt/dz times z, projection infinite
    if (depth_model.finite()) window_depth_error = depth * depth * (far - near) / (far * near);
    if (depth_model.reversed()) window_depth_error = depth;
    if (depth_model.parallel) window_depth_error = (far - near) / (1 - depth_model.front);
    return depth_roundings * window_depth_error;
}

// The transform's sums round 5 times a face (see lateral_error). Reversed depth is n/w, and as far
// off as w. In standard depth z/w the numerator is rounded by itself, and dt/dz = t^2 / n over w =
// t leaves t / n of the terms' error. What rounds the direction of a volume's side moves its
// points, in numerator and w alike. Parallel depth has a constant term, which is as much as the far
// plane's depth or, in standard depth, half of both planes'.
double transform_depth_error(const Scene& scene, const DepthModel& depth_model,
                             const glm::dvec3& point) {
    const double t = depth_of(scene.camera, point);
    const bool grows = !depth_model.reversed() && !depth_model.parallel;
    const double growth = grows ? std::max(t / depth_model.near, 1.0) : 1;
    const double constant = depth_model.parallel ? depth_model.far : 0;
    return 2 * transform_roundings * v *
           (growth * position_terms(scene, depth_model, scene.camera.forward, point) +
            direction_terms(scene, scene.camera.forward, point) + constant);
}

double depth_error(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point) {
    return stored_depth_error(depth_model, depth_of(scene.camera, point)) +
           transform_depth_error(scene, depth_model, point);
}

} // namespace shadowproof
