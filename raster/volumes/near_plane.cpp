#include "raster/volumes/near_plane.h"

#include "raster/gl/shader.h"
#include "raster/volumes/near_cap.h"
#include "raster/volumes/volume.h"
#include "scenes/mesh/topology.h"
#include "scenes/mesh/touching_light.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <memory>

namespace shadowproof {

namespace {

/// The projection into [0, 1] whose depths equal those drawn into [ledge, 1].
glm::mat4 clip_from_view_on_ledge(const Scene& scene, const DepthModel& depth_model) {
    Camera camera = scene.camera;
    camera.near = ledge_near(depth_model);
    return glm::mat4(clip_from_view_finite(camera, depth_model.far));
}

struct Capped {
    std::vector<std::uint32_t> welded;
    Program cut_program;
    Program cap_program;
    VertexArray points;
    Buffer point_buffer;
    Triangles cut_sides;
    Triangles near_caps;
    Triangles light_caps;
    Triangles flipped_caps;
};

} // namespace

VolumePass make_capped_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                            const ClipTransform& transform, const DepthModel& depth_model,
                            const SpecialCaps& special, const SplitFarEnds& split) {
    const auto made = std::make_shared<Capped>();
    made->welded = weld_by_position(scene.positions);
    made->cut_program = link_files(gl, {"view_space.vert", "volume.frag"});
    const glm::mat4 projection = clip_from_view_on_ledge(scene, depth_model);
    gl.ProgramUniformMatrix4fv(made->cut_program.name(), 0, 1, GL_FALSE,
                               glm::value_ptr(projection));
    made->cap_program = link_projection(gl, "volume.frag", transform, geometry);
    made->points = make_vertex_array(gl);
    gl.VertexArrayAttribFormat(made->points.name(), 0, 4, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(made->points.name(), 0, 0);
    gl.EnableVertexArrayAttrib(made->points.name(), 0);

    const auto update = [&gl, &scene, &split, made, special] {
        ShadowVolume volume;
        volume.facing = triangles_facing_light(scene);
        const NearCut cut = cut_at_near_plane(scene, made->welded, volume.facing, split);
        made->point_buffer =
            make_filled_buffer(gl, std::array{std::as_bytes(std::span(cut.points))});
        gl.VertexArrayVertexBuffer(made->points.name(), 0, made->point_buffer.name(), 0,
                                   sizeof(glm::vec4));
        for (const std::uint32_t triangle : volume.facing)
            volume.light_cap.push_back(scene.triangles[triangle]);
        set_special_caps(special, volume);
        const auto upload = [&](const std::vector<glm::uvec3>& triangles) {
            return upload_triangles(gl, std::array{std::span<const glm::uvec3>(triangles)});
        };
        made->cut_sides = upload(cut.sides);
        made->near_caps = upload(cut.caps);
        made->light_caps = upload(volume.light_cap);
        made->flipped_caps = upload(volume.flipped_caps);
    };
    const auto draw = [&gl, &geometry, made] {
        gl.UseProgram(made->cut_program.name());
        gl.BindVertexArray(made->points.name());
        const auto draw_cut = [&](const Triangles& triangles) {
            gl.VertexArrayElementBuffer(made->points.name(), triangles.buffer.name());
            gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles.count),
                            GL_UNSIGNED_INT, nullptr);
        };
        gl.DepthRange(0, 1);
        draw_cut(made->cut_sides);
        gl.DepthRange(0, 0); // at the front of the ledge
        draw_cut(made->near_caps);
        gl.DepthRange(ledge, 1);
        gl.BindVertexArray(geometry.vertices.name());
        gl.UseProgram(made->cap_program.name());
        draw_triangles(gl, geometry, made->light_caps, 0, made->light_caps.count);
    };
    const auto draw_flipped = [&gl, &geometry, made] {
        gl.UseProgram(made->cap_program.name());
        draw_triangles(gl, geometry, made->flipped_caps, 0, made->flipped_caps.count);
    };
    return {.update = update,
            .draw = draw,
            .draw_flipped = draw_flipped,
            .programs = {made->cut_program.name(), made->cap_program.name()}};
}

namespace {

/// The point that occluders' positions are relative to: the eye; but the light where one is
/// near it, because next to the light a difference from any other point keeps few bits of the
/// direction.
glm::dvec3 origin_of_occluders(const Scene& scene, bool near_light) {
    return near_light ? chosen_light(scene).position : scene.camera.eye;
}

/// Half of the part of the near plane that is in the picture.
glm::dvec2 extent_of_near_plane(const Camera& camera) {
    return half_extent(camera) * (camera.is_orthographic() ? 1 : camera.near);
}

/// With view coordinates (x, y, depth), a homogeneous light (l, w) and the near plane's depth n,
/// the shadow of a point p falls on (p (l.depth - w n) - l (p.depth - n)) / (l.depth - w p.depth):
/// homogeneous, its sign chosen so that the divisor is positive for what lies on the plane's side
/// of the light. Row z tells how far p lies on the light's side of the plane. Relative to the
/// light, p = l
/// + q, it is (q (n - l.depth) + l q.depth) / q.depth, without a constant.
glm::dmat4 clip_from_occluder(const Scene& scene, bool near_light) {
    const Camera& camera = scene.camera;
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec3 from_eye = glm::dvec3(light) - light.w * camera.eye;
    const glm::dvec3 l(glm::dot(camera.right, from_eye), glm::dot(camera.up, from_eye),
                       glm::dot(camera.forward, from_eye));
    const double to_plane = light.w * camera.near - l.z;
    const double sign = to_plane < 0 ? -1 : 1;
    const glm::dvec2 extent = extent_of_near_plane(camera);
    // Rows: coefficients of a point relative to the origin, and the constant.
    const auto across = [&](const glm::dvec3& axis, double of_light, double half) {
        const glm::dvec4 along(camera.forward, near_light ? 0 : -camera.near);
        return (glm::dvec4(axis, 0) * std::abs(to_plane) + along * (sign * of_light)) / half;
    };
    const double before = near_light ? to_plane : camera.near; // of the origin, before the plane
    const std::array<glm::dvec4, 4> rows{
        across(camera.right, l.x, extent.x), across(camera.up, l.y, extent.y),
        -sign * glm::dvec4(camera.forward, -before),
        sign * glm::dvec4(light.w * camera.forward, near_light ? 0 : -l.z)};
    glm::dmat4 matrix(0);
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) matrix[k][i] = rows[static_cast<std::size_t>(i)][k];
    return matrix;
}

struct Occluders {
    Program program;
    Triangles triangles;
};

/// The triangles that face the light.
std::vector<glm::uvec3> occluding_triangles(const Scene& scene, const SplitFarEnds& split,
                                            std::uint32_t first) {
    std::vector<glm::uvec3> occluders;
    std::uint32_t corner = first + static_cast<std::uint32_t>(split.directions.size());
    for (const std::uint32_t triangle : triangles_facing_light(scene)) {
        const glm::uvec3 corners = scene.triangles[triangle];
        if (split.behind(triangle) == nullptr) {
            occluders.push_back(corners);
            continue;
        }
        const auto near_light = [&](std::uint32_t position) {
            const std::uint32_t* own = split.of(position);
            if (own != nullptr) return first + *own;
            const int k = position == corners.x ? 0 : (position == corners.y ? 1 : 2);
            return corner + static_cast<std::uint32_t>(k);
        };
        const std::vector<glm::uvec3> fan =
            far_fan(split, triangle, corners, near_light,
                    [&](std::uint32_t direction) { return first + direction; });
        occluders.insert(occluders.end(), fan.begin(), fan.end());
        corner += 3;
    }
    return occluders;
}

} // namespace

// clip_from_occluder's rows in floats: an entry, its product and the sums round 5 times, the point
// relative to the origin twice before. That moves a coordinate of the size of the row's terms by 7
// v of it; divided by the last row, which in the plane is the light's distance from it, and times
// half the picture, these are pixels. Of a point that is seen in the near plane, no component is
// larger than the far end of that plane's diagonal. Of a triangle that almost touches the light,
// clipping moves the corner next to the light in all directions.
bool places_occluders(const Scene& scene) {
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < casts.size(); ++triangle)
        if (casts[triangle] != 0 && almost_touches_light(scene, triangle)) return false;
    const Camera& camera = scene.camera;
    const bool near_light = casters_near_light(scene);
    const glm::dmat4 matrix = clip_from_occluder(scene, near_light);
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec3 from_eye = glm::dvec3(light) - light.w * camera.eye;
    const double to_plane = std::abs(light.w * camera.near - glm::dot(camera.forward, from_eye));
    const double reach = glm::length(glm::dvec3(extent_of_near_plane(camera), camera.near)) +
                         glm::length(camera.eye - origin_of_occluders(scene, near_light));
    const std::array sizes{camera.width, camera.height};
    return std::ranges::all_of(std::array{0, 1}, [&](int axis) {
        const double terms =
            glm::dot(glm::abs(glm::row(matrix, axis)), glm::dvec4(reach, reach, reach, 1));
        const double pixels =
            0.5 * sizes[static_cast<std::size_t>(axis)] * 7 * float_roundoff * terms;
        return pixels <= to_plane;
    });
}

std::vector<glm::vec3> occluder_points(const Scene& scene, const SplitFarEnds& split) {
    const Camera& camera = scene.camera;
    const glm::dvec3 light = chosen_light(scene).position;
    // Half way to the near plane, so that all lie on the light's side of it.
    const double distance =
        0.5 * std::abs(glm::dot(camera.forward, light - camera.eye) - camera.near);
    std::vector<glm::vec3> points = points_along(scene, split, distance);
    for (const auto& [triangle, behind] : split.behind_triangle)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 away = corner(scene, triangle, k) - light;
            const double length = glm::length(away);
            points.emplace_back(length > 0 ? light + away * (distance / length) : light);
        }
    return points;
}

VolumePass make_occluder_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                              const SplitFarEnds& far_ends, std::uint32_t first, bool near_light) {
    const auto made = std::make_shared<Occluders>();
    made->program = link_files(gl, {"from_light.vert", "volume.frag"});
    const auto update = [&gl, &scene, &far_ends, made, first, near_light] {
        const TwoFloats origin = split(origin_of_occluders(scene, near_light));
        const glm::mat4 matrix(clip_from_occluder(scene, near_light));
        const GLuint program = made->program.name();
        gl.ProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, glm::value_ptr(matrix));
        gl.ProgramUniform3fv(program, 1, 1, glm::value_ptr(origin.high));
        gl.ProgramUniform3fv(program, 2, 1, glm::value_ptr(origin.low));
        const std::vector<glm::uvec3> occluders = occluding_triangles(scene, far_ends, first);
        made->triangles = upload_triangles(gl, std::array{std::span<const glm::uvec3>(occluders)});
    };
    const auto draw = [&gl, &geometry, made] {
        gl.UseProgram(made->program.name());
        gl.Disable(GL_DEPTH_TEST);
        gl.Enable(GL_DEPTH_CLAMP);
        gl.Enable(GL_CLIP_DISTANCE0);
        draw_triangles(gl, geometry, made->triangles, 0, made->triangles.count);
        gl.Disable(GL_CLIP_DISTANCE0);
        gl.Disable(GL_DEPTH_CLAMP);
        gl.Enable(GL_DEPTH_TEST);
    };
    return {
        .update = update, .draw = draw, .draw_flipped = [] {}, .programs = {made->program.name()}};
}

} // namespace shadowproof
