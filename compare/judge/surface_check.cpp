#include "compare/judge/surface_check.h"

#include "compare/driver/cut_surfaces.h"

#include <algorithm>
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

/// The keys between which what is drawn of a triangle lies at a pixel: surfaces are cut at the near
/// and the far plane, whether or not volumes are, but for floats and for being drawn aside.
struct KeyRange {
    double least = 0;
    double most = 0;

    bool holds(double key) const { return key >= least && key <= most; }
};
KeyRange drawn_keys(const DepthPicture& picture, std::uint32_t triangle, const PlaneAtPixel& at,
                    const ClipErrors& errors) {
    const Camera& camera = picture.scene.camera;
    const DepthModel& model = picture.model;
    const double aside = at.error_of_place();
    const bool by_fragments = model.clamp || !model.clips_at_far();
    const double of_fragment = by_fragments ? fragment_error(picture, triangle, at) : 0;
    const double of_near = aside + (model.clamp ? of_fragment : 0);
    const double of_far = aside + (model.clips_at_far() ? 0 : of_fragment);
    const double near = camera.near - errors.near;
    const double far = camera.far + errors.far;
    if (camera.is_orthographic()) return {near - of_near, far + of_far};
    return {1 / far - of_far, 1 / std::max(near, 0.0) + of_near};
}

/// The picture with the planes where the clipper's floats may put them.
DepthPicture with_planes_moved(DepthPicture picture, const ClipErrors& errors) {
    picture.drawing.near -= errors.near;
    picture.drawing.far += errors.far;
    picture.far += errors.far;
    return picture;
}

bool is_within_planes(const Camera& camera, double key) {
    const double depth = camera.is_orthographic() ? key : 1 / key;
    return depth >= camera.near && depth <= camera.far;
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
    if (!plane.has_depth()) return true;
    if (is_within_planes(tracer_.scene().camera, plane.key()) && plane.is_depth(depth)) return true;
    const ClipErrors errors = clip_errors(tracer_.scene(), triangle, picture_.drawing);
    return drawn_keys(picture_, triangle, plane, errors).holds(plane.key()) &&
           PlaneAtPixel(with_planes_moved(picture_, errors), triangle, x, y).is_depth(depth);
}

} // namespace shadowproof
