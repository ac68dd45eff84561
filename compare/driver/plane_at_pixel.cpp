#include "compare/driver/plane_at_pixel.h"

#include "compare/driver/error_bounds.h"
#include "compare/driver/setup_error.h"
#include "reference/trace/faces.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

SeenPlane plane_before_eye(const Scene& scene, std::uint32_t triangle) {
    const auto [a, b, c] = from_short_edge(
        {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)});
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const Camera& camera = scene.camera;
    if (!camera.is_orthographic()) return {normal / glm::dot(a - camera.eye, normal), 0};
    const double along = glm::dot(camera.forward, normal); // t = (a - S) . n / (forward . n)
    return {-normal / along, glm::dot(a, normal) / along};
}

namespace {

/// Of a projection whose window depths reach from 0 to 1.
WindowDepth full_window_depth(const DepthModel& model) {
    const double n = model.near;
    const double f = model.far;
    if (model.parallel)
        return model.reversed() ? WindowDepth{f / (f - n), -1 / (f - n)}
                                : WindowDepth{-n / (f - n), 1 / (f - n)};
    switch (model.projection) {
    case DepthModel::Projection::finite:
        return {f / (f - n), -f * n / (f - n)};
    case DepthModel::Projection::finite_reversed:
        return {-n / (f - n), f * n / (f - n)};
    case DepthModel::Projection::infinite:
        break;
    case DepthModel::Projection::infinite_reversed:
        return {0, n};
    }
    return {1, -n};
}

} // namespace

WindowDepth window_depth_of(const DepthModel& model) {
    const WindowDepth depth = full_window_depth(model);
    return {model.front + (1 - model.front) * depth.at_zero, (1 - model.front) * depth.slope};
}

DepthPicture depth_picture(const Scene& scene, const DepthModel& model, const Drawing& drawing,
                           double far) {
    const WindowDepth window = window_depth_of(model);
    const glm::dvec2 size(scene.camera.width, scene.camera.height);
    return {.scene = scene,
            .model = model,
            .drawing = drawing,
            .far = far,
            .window = window,
            .pixel = 2.0 * half_extent(scene.camera) / size,
            .snapped_by = half_snapping_step(model.subpixel_bits),
            .depth_rounds = window_depth_roundings * float_roundoff / std::abs(window.slope)};
}

PlaneAtPixel::PlaneAtPixel(const DepthPicture& picture, std::uint32_t triangle, int x, int y)
    : PlaneAtPixel(picture, triangle, plane_before_eye(picture.scene, triangle),
                   line_of_sight(picture.scene.camera, x + 0.5, y + 0.5)) {}

double PlaneAtPixel::slope() const {
    const Camera& camera = picture_.scene.camera;
    return picture_.pixel.x * std::abs(glm::dot(camera.right, plane_.gradient)) +
           picture_.pixel.y * std::abs(glm::dot(camera.up, plane_.gradient));
}

double PlaneAtPixel::least_error(double window_depth) const {
    const double size = picture_.model.reversed() ? std::min(window_depth, 1.0) : 1;
    return picture_.snapped_by * slope() + size * picture_.depth_rounds;
}

double PlaneAtPixel::depth() const {
    const double far = picture_.far;
    if (picture_.model.parallel) return std::clamp(key_, picture_.model.near, far);
    return key_ > 0 ? std::min(1 / key_, far) : far;
}

double PlaneAtPixel::error() const {
    const double squared = picture_.model.parallel ? 1 : depth() * depth();
    const CoveredPixel pixel{centre_, lateral(), picture_.drawing};
    return error_of_place() + setup_error(picture_.scene, triangle_, pixel) +
           0.5 * stored_depth_error(picture_.model, depth()) / squared;
}

double PlaneAtPixel::spread() const {
    return lateral() * std::max(picture_.pixel.x, picture_.pixel.y);
}

double PlaneAtPixel::lateral() const {
    return lateral_error(picture_.scene, picture_.model,
                         point_on(picture_.scene.camera, centre_, depth()));
}

bool PlaneAtPixel::is_depth(double read) const {
    const WindowDepth& window = picture_.window;
    const double off = std::abs(read - window.at(key_)) / std::abs(window.slope);
    return off <= least_error(read) || off <= error();
}

} // namespace shadowproof
