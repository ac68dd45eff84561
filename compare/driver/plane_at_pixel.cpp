#include "compare/driver/plane_at_pixel.h"

#include "compare/driver/error_bounds.h"
#include "compare/driver/setup_error.h"
#include "reference/trace/faces.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

glm::dvec3 plane_before_eye(const Scene& scene, std::uint32_t triangle) {
    const auto [a, b, c] = from_short_edge(
        {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)});
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    return normal / glm::dot(a - scene.camera.eye, normal);
}

WindowDepth window_depth_of(const DepthModel& model) {
    const double n = model.near;
    const double f = model.far;
    WindowDepth depth{1, -n};
    switch (model.projection) {
    case DepthModel::Projection::finite:
        depth = {f / (f - n), -f * n / (f - n)};
        break;
    case DepthModel::Projection::finite_reversed:
        depth = {-n / (f - n), f * n / (f - n)};
        break;
    case DepthModel::Projection::infinite:
        break;
    case DepthModel::Projection::infinite_reversed:
        depth = {0, n};
        break;
    }
    return {model.front + (1 - model.front) * depth.at_infinity, (1 - model.front) * depth.slope};
}

PlaneAtPixel::PlaneAtPixel(const Scene& scene, const DepthModel& model, const Drawing& drawing,
                           double far, std::uint32_t triangle, int x, int y)
    : PlaneAtPixel(scene, model, drawing, far, triangle, plane_before_eye(scene, triangle),
                   ray_direction(scene.camera, x + 0.5, y + 0.5)) {}

PlaneAtPixel::PlaneAtPixel(const Scene& scene, const DepthModel& model, const Drawing& drawing,
                           double far, std::uint32_t triangle, const glm::dvec3& plane,
                           const glm::dvec3& centre)
    : scene_(scene), model_(model), drawing_(drawing), far_(far), triangle_(triangle),
      centre_(centre), plane_(plane), inverse_(glm::dot(centre_, plane_)) {}

glm::dvec2 PlaneAtPixel::pixel() const {
    const glm::dvec2 half = half_extent(scene_.camera);
    return {2 * half.x / scene_.camera.width, 2 * half.y / scene_.camera.height};
}

double PlaneAtPixel::slope() const {
    return pixel().x * std::abs(glm::dot(scene_.camera.right, plane_)) +
           pixel().y * std::abs(glm::dot(scene_.camera.up, plane_));
}

bool PlaneAtPixel::has_depth() const {
    return std::isfinite(inverse_) && std::isfinite(plane_.x + plane_.y + plane_.z);
}

double PlaneAtPixel::least_error(double window_depth) const {
    const double size = model_.reversed() ? std::min(window_depth, 1.0) : 1;
    return half_snapping_step(model_.subpixel_bits) * slope() +
           window_depth_roundings * float_roundoff * size / std::abs(window_depth_of(model_).slope);
}

double PlaneAtPixel::error() const {
    const double depth = inverse_ > 0 ? std::min(1 / inverse_, far_) : far_;
    const CoveredPixel pixel{centre_, lateral(), drawing_};
    return error_of_place() + setup_error(scene_, triangle_, pixel) +
           0.5 * stored_depth_error(model_, depth) / (depth * depth);
}

double PlaneAtPixel::spread() const {
    return lateral() * std::max(pixel().x, pixel().y);
}

double PlaneAtPixel::lateral() const {
    const double depth = inverse_ > 0 ? std::min(1 / inverse_, far_) : far_;
    return lateral_error(scene_, model_, scene_.camera.eye + depth * centre_);
}

bool PlaneAtPixel::is_depth(double read) const {
    const WindowDepth window = window_depth_of(model_);
    const double off = std::abs(read - window.at(inverse_)) / std::abs(window.slope);
    return off <= least_error(read) || off <= error();
}

} // namespace shadowproof
