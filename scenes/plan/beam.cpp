#include "scenes/plan/beam.h"

#include "scenes/driver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

/// How far off a rasterizer's float transform may put a point, relative to the largest coordinate
/// in play: a dot product of 4 terms, each with 8 roundings of 2^-24 at most, and as much again
/// for the rounding of the matrix. Double rounding, 2^-53, vanishes beside it.
constexpr double transform_error = 4 * 8 * 2 * float_roundoff;

/// The lines of sight through the picture's own corners.
std::array<glm::dvec3, 4> corner_lines(const Camera& camera) {
    return shadowproof::corner_lines(camera, 0, 0, camera.width, camera.height);
}

double size_of(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The largest coordinate of anything that is transformed, and of the picture at depth `depth`.
double largest_coordinate(const Scene& scene, double largest, double depth) {
    largest = std::max(largest, size_of(scene.camera.eye));
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    if (light.w != 0) largest = std::max(largest, size_of(light));
    for (const glm::dvec3& line : corner_lines(scene.camera))
        largest = std::max(largest, size_of(point_on(scene.camera, line, depth)));
    return largest;
}

/// The range that the beam covers along an axis, its margin included.
Beam::Axis extent(const Beam& beam, const glm::dvec3& direction) {
    Beam::Axis axis{direction, glm::dot(direction, beam.points[0]), 0};
    axis.high = axis.low;
    for (const glm::dvec3& point : beam.points) {
        axis.low = std::min(axis.low, glm::dot(direction, point));
        axis.high = std::max(axis.high, glm::dot(direction, point));
    }
    const double margin = beam.margin * glm::length(direction);
    axis.low -= margin;
    axis.high += margin;
    return axis;
}

/// Whether all of `points` lie on one side of the beam. Any axis is valid; a zero axis separates
/// nothing.
bool separates(const Beam::Axis& axis, const Beam& beam, std::span<const glm::dvec3> points) {
    bool below = true;
    bool above = true;
    for (const glm::dvec3& point : points) {
        const double place = glm::dot(axis.direction, point - beam.origin);
        below = below && place < axis.low;
        above = above && place > axis.high;
    }
    return below || above;
}

/// A corner of the beam's target, and the edges that leave it.
struct BodyCorner {
    glm::dvec3 point;
    std::vector<glm::dvec3> edges;
};

/// The hull of those corners and the light. For a point light it is relative to the light, which is
/// its last point; a light in a face's plane flattens the beam, which the axes allow. For a
/// directional light it is relative to the eye, and as long as any scene in it can be: two points
/// are apart by no more than 2 sqrt(3) times the largest coordinate. The direction to the light,
/// normalised, is rounded as points are, which counts as much as the beam is long.
Beam beam_to(const Scene& scene, std::span<const BodyCorner> corners, double largest) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const bool directional = light.w == 0;
    const glm::dvec3 along = 4 * largest * glm::dvec3(light);
    Beam beam;
    beam.origin = directional ? scene.camera.eye : glm::dvec3(light);
    beam.margin = transform_error * (directional ? 4 : 1) * largest;
    std::vector<glm::dvec3> axes{scene.camera.forward};
    for (const auto& [point, edges] : corners) {
        beam.points.push_back(point - beam.origin);
        const glm::dvec3 ray = directional ? along : beam.points.back();
        for (const glm::dvec3& edge : edges) axes.push_back(glm::cross(ray, edge));
        if (directional) beam.points.push_back(beam.points.back() + along);
    }
    if (!directional) beam.points.emplace_back(0, 0, 0);
    for (const glm::dvec3& axis : axes) beam.axes.push_back(extent(beam, axis));
    return beam;
}

/// The corners of the rectangle, each with the edge to the next.
std::vector<BodyCorner> rectangle(const Camera& camera, double depth) {
    const std::array<glm::dvec3, 4> lines = corner_lines(camera);
    std::vector<BodyCorner> corners;
    for (std::size_t i = 0; i < 4; ++i)
        corners.push_back({point_on(camera, lines[i], depth), {lines[(i + 1) % 4] - lines[i]}});
    return corners;
}

} // namespace

TriangleCorners corners_of(const Scene& scene, std::uint32_t triangle) {
    return {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)};
}

double largest_position(const Scene& scene) {
    double largest = 0;
    for (const glm::dvec3 position : scene.positions)
        largest = std::max(largest, size_of(position));
    return largest;
}

Beam beam_to_rectangle(const Scene& scene, double largest, double depth) {
    return beam_to(scene, rectangle(scene.camera, depth),
                   largest_coordinate(scene, largest, depth));
}

namespace {

/// Of an orthographic camera: its lines of sight between the near plane and a depth.
Beam beam_to_visible_box(const Scene& scene, double largest, double depth) {
    const Camera& camera = scene.camera;
    std::vector<BodyCorner> corners = rectangle(camera, depth);
    for (BodyCorner& corner : rectangle(camera, camera.near)) {
        corner.edges.push_back(camera.forward);
        corners.push_back(std::move(corner));
    }
    Beam beam = beam_to(scene, corners, largest_coordinate(scene, largest, depth));
    for (const glm::dvec3& side : {camera.right, camera.up})
        beam.axes.push_back(extent(beam, side));
    return beam;
}

} // namespace

Beam beam_to_pyramid(const Scene& scene, double largest, double depth) {
    if (scene.camera.is_orthographic()) return beam_to_visible_box(scene, largest, depth);
    std::vector<BodyCorner> corners = rectangle(scene.camera, depth);
    const std::array<glm::dvec3, 4> rays = corner_lines(scene.camera);
    corners.push_back({scene.camera.eye, {rays.begin(), rays.end()}});
    Beam beam = beam_to(scene, corners, largest_coordinate(scene, largest, depth));
    for (std::size_t i = 0; i < 4; ++i)
        beam.axes.push_back(extent(beam, glm::cross(rays[i], rays[(i + 1) % 4])));
    return beam;
}

Beam beam_to_box(const Scene& scene, double largest, const glm::dvec3& low,
                 const glm::dvec3& high) {
    std::vector<BodyCorner> corners;
    for (const double x : {low.x, high.x})
        for (const double y : {low.y, high.y})
            for (const double z : {low.z, high.z})
                corners.push_back({{x, y, z}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    return beam_to(scene, corners, largest_coordinate(scene, largest, scene.camera.near));
}

bool may_meet(const Beam& beam, std::span<const glm::dvec3> points,
              std::span<const glm::dvec3> own) {
    const auto finds_gap = [&](const Beam::Axis& axis) { return separates(axis, beam, points); };
    return std::none_of(beam.axes.begin(), beam.axes.end(), finds_gap) &&
           std::none_of(own.begin(), own.end(), [&](const glm::dvec3& direction) {
               return finds_gap(extent(beam, direction));
           });
}

bool may_meet(const Beam& beam, const TriangleCorners& corners) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    return may_meet(beam, corners, std::span(&normal, 1));
}

PictureCone picture_cone(const Scene& scene) {
    const Camera& camera = scene.camera;
    const std::array<glm::dvec3, 4> rays = corner_lines(camera);
    PictureCone cone;
    for (std::size_t i = 0; i < 4; ++i) // corners run clockwise as seen from the eye
        cone.inward[i] = glm::normalize(glm::cross(rays[i], rays[(i + 1) % 4]));
    if (camera.is_orthographic())
        cone.inward = {camera.right, -camera.right, camera.up, -camera.up, {}};
    cone.inward[4] = camera.forward;
    cone.error =
        transform_error * largest_coordinate(scene, largest_position(scene), scene.camera.near);
    return cone;
}

PictureCone opposite(PictureCone cone) {
    for (glm::dvec3& normal : cone.inward) normal = -normal;
    return cone;
}

// The margin is an angle, plus the transform's error at the vertex.
bool may_point_into(const PictureCone& cone, const TriangleCorners& corners,
                    const glm::dvec3& from) {
    return std::none_of(cone.inward.begin(), cone.inward.end(), [&](const glm::dvec3& axis) {
        return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& point) {
            const glm::dvec3 direction = point - from;
            const double margin = transform_error * glm::length(direction) + cone.error;
            return glm::dot(axis, direction) < -margin;
        });
    });
}

bool may_be_in_picture(const Camera& camera, const PictureCone& cone,
                       const TriangleCorners& corners) {
    if (!camera.is_orthographic()) return may_point_into(cone, corners, camera.eye);
    const glm::dvec2 half = half_extent(camera) + cone.error;
    const auto is_beyond = [&](const glm::dvec3& side, double most) {
        return std::ranges::all_of(corners, [&](const glm::dvec3& point) {
            return glm::dot(side, point - camera.eye) > most;
        });
    };
    return !is_beyond(camera.right, half.x) && !is_beyond(-camera.right, half.x) &&
           !is_beyond(camera.up, half.y) && !is_beyond(-camera.up, half.y);
}

} // namespace shadowproof
