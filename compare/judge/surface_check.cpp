#include "compare/judge/surface_check.h"

#include "compare/driver/error_bounds.h"
#include "compare/driver/neighbourhood.h"
#include "compare/driver/setup_error.h"
#include "reference/trace/faces.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// Window depth is `at_infinity` + `slope` times the inverse view depth.
struct WindowDepth {
    double at_infinity = 0;
    double slope = 0;
};

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

/// A triangle's plane: the inverse view depth along a ray of direction D is D . plane. Not finite
/// where the eye lies in it.
glm::dvec3 plane_of(const Scene& scene, std::uint32_t triangle) {
    const auto [a, b, c] = from_short_edge(
        {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)});
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    return normal / glm::dot(a - scene.camera.eye, normal);
}

/// A buffer of 24 bits holds multiples of 1 / (2^24 - 1), which come back as floats: off by half of
/// their last place.
bool is_on_grid(float depth) {
    const double steps = double{depth} * 0xffffff;
    const double half_place = 0.5 * (std::nextafter(depth, 2.0F) - double{depth}) * 0xffffff;
    return std::abs(steps - std::round(steps)) <= half_place;
}

} // namespace

double window_depth(const DepthModel& model, double inverse_depth) {
    const WindowDepth depth = window_depth_of(model);
    return depth.at_infinity + depth.slope * inverse_depth;
}

// The sign of the determinant of the corners relative to the eye is the side that is seen. A corner
// at depth t that moves by t times the error changes it by no more than its share.
bool may_be_drawn(const Tracer& tracer, std::uint32_t triangle, double error) {
    if (sides_of(tracer, triangle).visible) return true;
    const Scene& scene = tracer.scene();
    const glm::dvec3 a = corner(scene, triangle, 0) - scene.camera.eye;
    const glm::dvec3 b = corner(scene, triangle, 1) - scene.camera.eye;
    const glm::dvec3 c = corner(scene, triangle, 2) - scene.camera.eye;
    const auto moved = [&](const glm::dvec3& corner) {
        return std::sqrt(3.0) * error * std::abs(glm::dot(corner, scene.camera.forward));
    };
    const double da = moved(a);
    const double db = moved(b);
    const double dc = moved(c);
    const double once = da * glm::length(glm::cross(b, c)) + db * glm::length(glm::cross(c, a)) +
                        dc * glm::length(glm::cross(a, b));
    const double twice =
        da * db * glm::length(c) + db * dc * glm::length(a) + dc * da * glm::length(b);
    return std::abs(glm::dot(a, glm::cross(b, c))) <= once + twice + da * db * dc;
}

namespace {

/// A triangle's plane at a pixel: the inverse view depth there, and how far off it may come out.
class PlaneAtPixel {
public:
    PlaneAtPixel(const Scene& scene, const Frame& frame, double far, std::uint32_t triangle, int x,
                 int y)
        : scene_(scene), frame_(frame), far_(far), triangle_(triangle),
          centre_(ray_direction(scene.camera, x + 0.5, y + 0.5)), plane_(plane_of(scene, triangle)),
          inverse_(glm::dot(centre_, plane_)) {
        const glm::dvec2 half = half_extent(scene.camera);
        pixel_ = {2 * half.x / scene.camera.width, 2 * half.y / scene.camera.height};
        slope_ = pixel_.x * std::abs(glm::dot(scene.camera.right, plane_)) +
                 pixel_.y * std::abs(glm::dot(scene.camera.up, plane_));
    }

    /// False if the eye lies in the plane: the triangle has no area in the picture, and any depth
    /// may come out.
    bool has_depth() const { return std::isfinite(inverse_) && std::isfinite(slope_); }
    double inverse_depth() const { return inverse_; }

    /// Half a step of the snapping grid and the roundings of a depth are part of any pixel's
    /// bounds, and nearly always enough.
    double least_error(double window_depth) const {
        const DepthModel& model = frame_.depth_model;
        const double size = model.reversed() ? std::min(window_depth, 1.0) : 1;
        return half_snapping_step(model.subpixel_bits) * slope_ +
               window_depth_roundings * v * size / std::abs(window_depth_of(model).slope);
    }
    /// Moving the pixel's centre changes the depth there by the slope. depth_error is for two
    /// depths that are compared; this is one depth.
    double error() const {
        const DepthModel& model = frame_.depth_model;
        const double depth = inverse_ > 0 ? std::min(1 / inverse_, far_) : far_;
        const double far = model.clips_at_far() ? far_ : std::numeric_limits<double>::infinity();
        const CoveredPixel pixel{centre_, lateral(), drawing_of(scene_, frame_, far)};
        return lateral() * slope_ + setup_error(scene_, triangle_, pixel) +
               0.5 * depth_error(scene_, model, place(depth)) / (depth * depth);
    }
    /// Largest error of a direction's component at the picture's corners.
    double spread() const { return lateral() * std::max(pixel_.x, pixel_.y); }

private:
    const Scene& scene_;
    const Frame& frame_;
    double far_;
    std::uint32_t triangle_;
    glm::dvec3 centre_;
    glm::dvec3 plane_;
    double inverse_;
    double slope_ = 0;       ///< change of the inverse depth, the largest over a pixel's step
    glm::dvec2 pixel_{0, 0}; ///< its sides at depth 1

    glm::dvec3 place(double depth) const { return scene_.camera.eye + depth * centre_; }
    double lateral() const {
        const double depth = inverse_ > 0 ? std::min(1 / inverse_, far_) : far_;
        return lateral_error(scene_, frame_.depth_model, place(depth));
    }
};

/// Surfaces are clipped at the near and far plane, whether or not volumes are.
bool is_within_planes(const Camera& camera, const PlaneAtPixel& plane) {
    const double nearest = 1 / camera.near;
    const double farthest = 1 / camera.far; // 0 where that is infinite
    const double inverse = plane.inverse_depth();
    if (inverse <= nearest && inverse >= farthest) return true;
    const double error = plane.error();
    return inverse - error <= nearest && inverse + error >= farthest;
}

bool is_depth_of(const PlaneAtPixel& plane, const DepthModel& model, double read) {
    const WindowDepth window = window_depth_of(model);
    const double off = std::abs(read - window.at_infinity - window.slope * plane.inverse_depth()) /
                       std::abs(window.slope);
    return off <= plane.least_error(read) || off <= plane.error();
}

} // namespace

// A float of 32 bits or a whole number of 24.
bool SurfaceCheck::has_format() const {
    const DepthFormat& format = frame_.depth_format;
    const bool floating = frame_.depth_model.floating;
    return format.floating == floating && format.bits == (floating ? 32 : 24);
}

bool SurfaceCheck::holds(int x, int y) const {
    const std::uint32_t triangle = frame_.triangle.at(x, y);
    const float depth = frame_.depth.at(x, y);
    const DepthModel& model = frame_.depth_model;
    if (!has_format()) return false;
    if (triangle == no_triangle) return depth == (model.reversed() ? 0.0F : 1.0F);
    if (!model.floating && !is_on_grid(depth)) return false;
    const PlaneAtPixel plane(tracer_.scene(), frame_, far_, triangle, x, y);
    if (!sides_of(tracer_, triangle).visible && !may_be_drawn(tracer_, triangle, plane.spread()))
        return false;
    return !plane.has_depth() ||
           (is_within_planes(tracer_.scene().camera, plane) && is_depth_of(plane, model, depth));
}

} // namespace shadowproof
