#include "compare/judge/surface_check.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// A buffer of 24 bits holds multiples of 1 / (2^24 - 1), which come back as floats: off by half of
/// their last place.
bool is_on_grid(float depth) {
    const double steps = double{depth} * 0xffffff;
    const double half_place = 0.5 * (std::nextafter(depth, 2.0F) - double{depth}) * 0xffffff;
    return std::abs(steps - std::round(steps)) <= half_place;
}

// The product of the normal e x f with the direction is the side that is seen. Both edges change by
// up to `moved`, and so the product by moved (|e| + |f| + moved).
bool may_be_drawn_in_parallel(const Scene& scene, std::uint32_t triangle, double error) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 e = corner(scene, triangle, 1) - a;
    const glm::dvec3 f = corner(scene, triangle, 2) - a;
    const double moved = 2 * std::sqrt(3.0) * error;
    return std::abs(glm::dot(scene.camera.forward, glm::cross(e, f))) <=
           moved * (glm::length(e) + glm::length(f) + moved);
}

} // namespace

// The sign of the determinant of the corners relative to the eye is the side that is seen. A corner
// at depth t that moves by t times the error changes it by no more than its share.
bool may_be_drawn(const Tracer& tracer, std::uint32_t triangle, double error) {
    if (sides_of(tracer, triangle).visible) return true;
    const Scene& scene = tracer.scene();
    if (scene.camera.is_orthographic()) return may_be_drawn_in_parallel(scene, triangle, error);
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

/// Surfaces are clipped at the near and far plane, whether or not volumes are.
bool is_within_planes(const Camera& camera, const PlaneAtPixel& plane) {
    const bool is_parallel = camera.is_orthographic();
    const double most = is_parallel ? camera.far : 1 / camera.near;
    const double least = is_parallel ? camera.near : 1 / camera.far; // 0 where that is infinite
    const double key = plane.key();
    if (key <= most && key >= least) return true;
    const double error = plane.error();
    return key - error <= most && key + error >= least;
}

} // namespace

SurfaceCheck::SurfaceCheck(const Tracer& tracer, const Frame& frame, double far)
    : tracer_(tracer), frame_(frame),
      picture_(depth_picture(tracer.scene(), frame.depth_model,
                             drawing_of(tracer.scene(), frame.depth_model,
                                        frame.depth_model.clips_at_far()
                                            ? far
                                            : std::numeric_limits<double>::infinity()),
                             far)) {}

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
    const PlaneAtPixel plane(picture_, triangle, x, y);
    if (!sides_of(tracer_, triangle).visible && !may_be_drawn(tracer_, triangle, plane.spread()))
        return false;
    return !plane.has_depth() ||
           (is_within_planes(tracer_.scene().camera, plane) && plane.is_depth(depth));
}

} // namespace shadowproof
