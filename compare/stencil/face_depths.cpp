#include "compare/stencil/face_depths.h"

#include "compare/driver/error_bounds.h"
#include "reference/trace/faces.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec3 ahead_of_eye(const Camera& camera, double depth) {
    return camera.eye + depth * camera.forward;
}

} // namespace

double plane_depth(const Scene& scene, std::uint32_t triangle, const glm::dvec3& line) {
    const double depth = depth_on_triangle(scene, triangle, line);
    const bool is_ahead = scene.camera.is_orthographic() ? std::isfinite(depth) : depth > 0;
    return is_ahead ? depth : infinity;
}

// On a ray D a plane is met at a depth that is inverse to D . plane; not at all where that changes
// its sign. A line that starts apart by d meets it nearer by d . plane over D . plane.
double face_depth(const Camera& camera, const Crossing& crossing, const glm::dvec3& line,
                  const glm::dvec3& other) {
    if (camera.is_orthographic())
        return crossing.depth -
               glm::dot(other - line, crossing.plane) / glm::dot(camera.forward, crossing.plane);
    const double ratio = glm::dot(line, crossing.plane) / glm::dot(other, crossing.plane);
    return ratio > 0 ? crossing.depth * ratio : infinity;
}

// A standard infinite projection's depths round to 1, what is cleared to, as soon as n / t is
// within the error of 1.
DepthRange FaceDepths::background() const {
    const DepthModel& model = frame_.depth_model;
    if (model.reversed() && !model.background_at_far()) return {infinity, infinity, infinity};
    if (model.projection == DepthModel::Projection::infinite)
        return {infinity, model.near / depth_roundings, infinity};
    const double q = depth_error(scene_, model, ahead_of_eye(scene_.camera, far_));
    return {far_, far_ - q, far_ + q};
}

DepthRange FaceDepths::surface(std::uint32_t triangle) const {
    DepthRange range{0, infinity, 0};
    const double setup = plane_error(triangle);
    // Seen edge-on, or without area: any depth may come out.
    if (!std::isfinite(setup) ||
        std::isnan(depth_on_triangle(scene_, triangle, around_.rays.front())))
        return {0, -infinity, infinity};
    for (const glm::dvec3& line : around_.corners) {
        const double t = plane_depth(scene_, triangle, line);
        const double slope_error = std::isfinite(t) ? setup * depths_of_key(t) : 0;
        range.include(t, stored_depth_error(frame_.depth_model, std::min(t, far_)) + slope_error);
    }
    return range;
}

DepthRange FaceDepths::face(const Crossing& crossing, const glm::dvec3& line) const {
    DepthRange range{crossing.depth, crossing.depth, crossing.depth};
    range.include(crossing.depth, setup_error_at(crossing));
    for (const glm::dvec3& other : around_.corners)
        range.include(face_depth(scene_.camera, crossing, line, other), 0);
    // Clamped to the near plane's depth, a face is no longer before what lies there.
    if (frame_.depth_model.clamp) {
        range.lower = std::max(range.lower, scene_.camera.near);
        range.upper = std::max(range.upper, scene_.camera.near);
    }
    return range;
}

double FaceDepths::depths_of_key(double depth) const {
    return frame_.depth_model.parallel ? 1 : depth * depth;
}

double FaceDepths::setup_error_at(const Crossing& crossing) const {
    return plane_error(crossing) * depths_of_key(crossing.depth);
}

double FaceDepths::clip_far() const {
    return frame_.depth_model.clips_at_far() ? far_ : infinity;
}

double FaceDepths::clip_depth(double depth, int move) const {
    return depth +
           move * depth_error(scene_, frame_.depth_model, ahead_of_eye(scene_.camera, depth));
}

CoveredPixel FaceDepths::covered_pixel() const {
    return {around_.rays.front(), around_.reach,
            drawing_of(scene_, frame_.depth_model, clip_far())};
}

// The light cap of a surface is that surface's own triangle.
double FaceDepths::plane_error(const Crossing& face) const {
    const bool is_surface =
        face.part == Crossing::Part::light_cap && face.triangle < scene_.triangles.size();
    if (is_surface) return plane_error(face.triangle);
    const auto [known, is_new] =
        setup_of_face_.try_emplace({face.part, face.is_side() ? face.edge : face.triangle}, 0.0);
    if (is_new)
        known->second = setup_error(volumes_.casters, volumes_.far_ends, face, covered_pixel());
    return known->second;
}

double FaceDepths::plane_error(std::uint32_t triangle) const {
    const auto [known, is_new] = setup_of_triangle_.try_emplace(triangle, 0.0);
    if (is_new) known->second = setup_error(scene_, triangle, covered_pixel());
    return known->second;
}

} // namespace shadowproof
