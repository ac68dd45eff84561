#include "scenes/camera.h"

#include <cassert>
#include <glm/geometric.hpp>

namespace shadowproof {

glm::dvec4 homogeneous_eye(const Camera& camera) {
    return camera.is_orthographic() ? glm::dvec4(-camera.forward, 0) : glm::dvec4(camera.eye, 1);
}

glm::dvec2 half_extent(const Camera& camera) {
    return {camera.half_height * camera.width / camera.height, camera.half_height};
}

glm::dvec3 sight_column(const Camera& camera, double x) {
    const glm::dvec3& centre = camera.is_orthographic() ? camera.eye : camera.forward;
    return centre + half_extent(camera).x * (2 * x / camera.width - 1) * camera.right;
}

glm::dvec3 sight_row(const Camera& camera, double y) {
    return half_extent(camera).y * (1 - 2 * y / camera.height) * camera.up;
}

glm::dvec3 line_of_sight(const Camera& camera, double x, double y) {
    return sight_column(camera, x) + sight_row(camera, y);
}

std::array<glm::dvec3, 4> corner_lines(const Camera& camera, double left, double top, double right,
                                       double bottom) {
    return {line_of_sight(camera, left, top), line_of_sight(camera, right, top),
            line_of_sight(camera, right, bottom), line_of_sight(camera, left, bottom)};
}

glm::dvec3 way_to_eye(const Camera& camera, const glm::dvec3& point) {
    return camera.is_orthographic() ? -camera.forward : glm::normalize(camera.eye - point);
}

double view_depth(const Camera& camera, const glm::dvec3& point) {
    return glm::dot(point - camera.eye, camera.forward);
}

glm::dvec2 project(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec3 relative = point - camera.eye;
    const double depth = camera.is_orthographic() ? 1 : glm::dot(relative, camera.forward);
    const glm::dvec2 half = half_extent(camera);
    return {(glm::dot(relative, camera.right) / (depth * half.x) + 1) * 0.5 * camera.width,
            (1 - glm::dot(relative, camera.up) / (depth * half.y)) * 0.5 * camera.height};
}

double pixels_of_length(const Camera& camera, double depth) {
    return 0.5 * camera.height / (camera.half_height * (camera.is_orthographic() ? 1 : depth));
}

glm::dmat3 view_from_eye_relative(const Camera& camera) {
    return glm::transpose(glm::dmat3(camera.right, camera.up, -camera.forward));
}

glm::dmat4 view_from_world(const Camera& camera) {
    const glm::dmat3 rotation = view_from_eye_relative(camera);
    glm::dmat4 view(rotation);
    view[3] = glm::dvec4(rotation * -camera.eye, 1);
    return view;
}

namespace {

/// The part all projections share: x and y scales, and w: -z of view space, or 1.
glm::dmat4 clip_without_depth(const Camera& camera) {
    const glm::dvec2 half = half_extent(camera);
    glm::dmat4 clip(0.0);
    clip[0][0] = 1 / half.x;
    clip[1][1] = 1 / half.y;
    if (camera.is_orthographic())
        clip[3][3] = 1;
    else
        clip[2][3] = -1;
    return clip;
}

/// Of a perspective camera.
glm::dmat4 perspective(const Camera& camera) {
    assert(!camera.is_orthographic());
    return clip_without_depth(camera);
}

} // namespace

glm::dmat4 clip_from_view_finite(const Camera& camera, double far) {
    const double near = camera.near;
    glm::dmat4 clip = clip_without_depth(camera);
    const double middle = -(far + near) / (far - near);
    const bool is_parallel = camera.is_orthographic();
    clip[2][2] = is_parallel ? -2 / (far - near) : middle;
    clip[3][2] = is_parallel ? middle : -2 * far * near / (far - near);
    return clip;
}

glm::dmat4 clip_from_view_infinite(const Camera& camera) {
    glm::dmat4 clip = perspective(camera);
    clip[2][2] = -1;
    clip[3][2] = -2 * camera.near;
    return clip;
}

glm::dmat4 clip_from_view_infinite_reversed(const Camera& camera) {
    glm::dmat4 clip = perspective(camera);
    clip[3][2] = camera.near;
    return clip;
}

glm::dmat4 clip_from_view_finite_reversed(const Camera& camera, double far) {
    const double near = camera.near;
    glm::dmat4 clip = clip_without_depth(camera);
    clip[2][2] = (camera.is_orthographic() ? 1 : near) / (far - near);
    clip[3][2] = far * (camera.is_orthographic() ? 1 : near) / (far - near);
    return clip;
}

} // namespace shadowproof
