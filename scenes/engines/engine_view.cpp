#include "scenes/engines/engine_view.h"

#include "scenes/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// Right, up and forward of what looks somewhere, in glTF's world, as columns.
struct Frame {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 forward;
};

/// Rotation of a node that stands so: frame = world_from_node * axes, and axes are orthogonal.
glm::dmat3 rotation_of(const Convention& convention, const Frame& frame) {
    return convention.world_from_gltf * glm::dmat3(frame.right, frame.up, frame.forward) *
           glm::transpose(convention.node_axes);
}

/// A frame that looks in a direction: level where it can be.
Frame frame_towards(const glm::dvec3& direction) {
    const glm::dvec3 forward = glm::normalize(direction);
    const bool steep = std::abs(forward.y) > std::abs(forward.x) + std::abs(forward.z);
    const glm::dvec3 hint = steep ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, hint));
    return {right, glm::cross(right, forward), forward};
}

double farthest_depth(const Scene& scene) {
    double depth = 2 * scene.camera.near;
    for (const glm::dvec3 position : scene.positions)
        depth = std::max(depth, view_depth(scene.camera, position));
    return depth;
}

/// The same where lines of sight are parallel: w is 1.
///   [-1, 1]: a = 2 / (f - n),       b = -(f + n) / (f - n)
///   [ 0, 1]: a = 1 / (f - n),       b = -n / (f - n)
///   [ 1, 0]: a = -1 / (f - n),      b = f / (f - n)
glm::dvec2 parallel_depth_row(NdcDepth range, double near, double far) {
    const double span = far - near;
    switch (range) {
    case NdcDepth::minus_one_to_one:
        return glm::dvec2(2, -(far + near)) / span;
    case NdcDepth::zero_to_one:
        return glm::dvec2(1, -near) / span;
    case NdcDepth::one_to_zero:
        break;
    }
    return glm::dvec2(-1, far) / span;
}

/// Depth is w. The third row (a, b) maps it to a * depth + b, which over w is
///   [-1, 1]: a = (f + n) / (f - n), b = -2 f n / (f - n);   without far plane 1, -2 n
///   [ 0, 1]: a = f / (f - n),       b = -f n / (f - n);     1, -n
///   [ 1, 0]: a = -n / (f - n),      b = f n / (f - n);      0, n
glm::dvec2 depth_row(NdcDepth range, double near, const std::optional<double>& far) {
    const double n = near;
    const double span = far ? *far - n : 1;
    switch (range) {
    case NdcDepth::minus_one_to_one:
        return far ? glm::dvec2((*far + n) / span, -2 * *far * n / span) : glm::dvec2(1, -2 * n);
    case NdcDepth::zero_to_one:
        return far ? glm::dvec2(*far / span, -*far * n / span) : glm::dvec2(1, -n);
    case NdcDepth::one_to_zero:
        break;
    }
    return far ? glm::dvec2(-n / span, *far * n / span) : glm::dvec2(0, n);
}

/// From right, up, depth, 1 to clip space.
glm::dmat4 clip_from_frame(const Camera& camera, const EngineView& view, NdcDepth range) {
    const glm::dvec2 half = view.extent ? 0.5 * *view.extent : half_extent(camera);
    const glm::dvec2 depth = view.extent ? parallel_depth_row(range, view.near, *view.far)
                                         : depth_row(range, view.near, view.far);
    glm::dmat4 clip(0.0);
    clip[0][0] = 1 / half.x;
    clip[1][1] = 1 / half.y;
    clip[2][2] = depth.x;
    clip[3][2] = depth.y;
    clip[view.extent ? 3 : 2][3] = 1;
    return clip;
}

void set_light(const Convention& convention, const Light& light, EngineView& view) {
    view.light_position = glm::dvec3(view.world_from_gltf * glm::dvec4(light.position, 1));
    if (light.kind == Light::Kind::point) return;
    view.light_direction = convention.world_from_gltf * light.direction;
    view.light_rotation = glm::quat_cast(rotation_of(convention, frame_towards(light.direction)));
}

} // namespace

EngineView view_in(const Convention& convention, const Scene& scene) {
    const Camera& camera = scene.camera;
    const double units = convention.units;
    EngineView view;
    view.world_from_gltf = glm::dmat4(units * convention.world_from_gltf);
    view.position = units * (convention.world_from_gltf * camera.eye);
    const glm::dmat3 rotation = rotation_of(convention, {camera.right, camera.up, camera.forward});
    view.rotation = glm::quat_cast(rotation);
    view.world_from_camera = glm::dmat4(rotation);
    view.world_from_camera[3] = glm::dvec4(view.position, 1);
    if (camera.is_orthographic()) {
        view.extent = 2 * units * half_extent(camera);
    } else {
        view.vertical_field_of_view = 2 * std::atan(half_extent(camera).y);
        view.horizontal_field_of_view = 2 * std::atan(half_extent(camera).x);
    }
    view.near = units * camera.near;
    if (std::isfinite(camera.far)) {
        view.far = units * camera.far;
    } else if (!convention.infinite_far || camera.is_orthographic()) {
        view.far = units * 2 * farthest_depth(scene);
        view.far_is_made_up = true;
    }
    // To the camera's own axes, by way of right, up and forward.
    const glm::dmat3 frame_from_node = glm::transpose(convention.node_axes);
    const glm::dmat3 view_from_node = convention.view_axes * frame_from_node;
    const glm::dmat3 view_rotation = view_from_node * glm::transpose(rotation);
    view.view_from_world = glm::dmat4(view_rotation);
    view.view_from_world[3] = glm::dvec4(view_rotation * -view.position, 1);
    view.clip_from_view = clip_from_frame(camera, view, convention.depth_range) *
                          glm::dmat4(glm::transpose(convention.view_axes));
    set_light(convention, chosen_light(scene), view);
    return view;
}

} // namespace shadowproof
