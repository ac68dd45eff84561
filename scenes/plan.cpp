#include "scenes/plan.h"

#include "scenes/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

namespace shadowproof {

double finite_far(const Scene& scene) {
    if (std::isfinite(scene.camera.far)) return scene.camera.far;
    double deepest = 0;
    for (const glm::dvec3 position : scene.positions)
        deepest = std::max(deepest, view_depth(scene.camera, position));
    return std::max(1.5 * deepest, 2 * scene.camera.near);
}

namespace {

/// How far off a rasterizer's float transform may put a point, relative to the largest coordinate
/// in play: a dot product of 4 terms, each with 8 roundings of 2^-24 at most, and as much again
/// for the rounding of the matrix: 4 * 8 * 2 * 2^-24. Double rounding, 2^-53, vanishes beside it.
constexpr double transform_error = 0x1p-18;

using Corners = std::array<glm::dvec3, 3>;

Corners corners_of(const Scene& scene, std::uint32_t triangle) {
    return {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)};
}

/// Whether `holds` is true of some triangle that casts.
template <class Holds>
bool some_caster(const Scene& scene, const Holds& holds) {
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        if (casts[triangle] != 0 && holds(triangle)) return true;
    return false;
}

/// The four rays through the picture's corners, at view depth 1, around the picture.
std::array<glm::dvec3, 4> corner_rays(const Camera& camera) {
    const double w = camera.width;
    const double h = camera.height;
    return {ray_direction(camera, 0, 0), ray_direction(camera, w, 0), ray_direction(camera, w, h),
            ray_direction(camera, 0, h)};
}

/// The largest coordinate of anything that is transformed, and of the picture at depth `depth`.
double largest_coordinate(const Scene& scene, double depth) {
    double largest = 0;
    const auto include = [&](const glm::dvec3& v) {
        largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    };
    for (const glm::dvec3 position : scene.positions) include(position);
    include(scene.camera.eye);
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    if (light.w != 0) include(light);
    for (const glm::dvec3& ray : corner_rays(scene.camera)) include(scene.camera.eye + depth * ray);
    return largest;
}

/// Whether all of `points` lie on one side of all of `others` along `axis`, at least `margin`
/// apart. Any axis is a sound one; a zero axis separates nothing.
bool are_separated(std::span<const glm::dvec3> points, std::span<const glm::dvec3> others,
                   const glm::dvec3& axis, double margin) {
    const auto interval = [&](std::span<const glm::dvec3> of) {
        double low = glm::dot(axis, of[0]);
        double high = low;
        for (const glm::dvec3& point : of) {
            low = std::min(low, glm::dot(axis, point));
            high = std::max(high, glm::dot(axis, point));
        }
        return std::pair(low, high);
    };
    const auto [low, high] = interval(points);
    const auto [other_low, other_high] = interval(others);
    const double distance = margin * glm::length(axis);
    return low > other_high + distance || high < other_low - distance;
}

/// What lies between the picture at some view depth and the light: the convex hull of `points`,
/// relative to `origin`, and the normals of its faces.
struct Beam {
    glm::dvec3 origin{0, 0, 0};
    std::vector<glm::dvec3> points;
    std::vector<glm::dvec3> axes;
    double margin = 0; ///< by which the rasterizer may miss it
};

/// Relative to a point light, which is its last point. A light in the rectangle's plane flattens
/// the beam, which the axes survive.
Beam beam_to_point(const Scene& scene, const glm::dvec3& light, double depth) {
    Beam beam{
        light, {}, {scene.camera.forward}, transform_error * largest_coordinate(scene, depth)};
    for (const glm::dvec3& ray : corner_rays(scene.camera))
        beam.points.push_back(scene.camera.eye + depth * ray - light);
    for (std::size_t i = 0; i < 4; ++i)
        beam.axes.push_back(glm::cross(beam.points[i], beam.points[(i + 1) % 4]));
    beam.points.emplace_back(0, 0, 0);
    return beam;
}

/// Relative to the eye, and as long as any scene in it can be: two points are apart by no more than
/// 2 sqrt(3) times the largest coordinate. The direction to the light, of unit length, is rounded
/// as points are, which weighs as much as the beam is long.
Beam beam_along(const Scene& scene, const glm::dvec3& to_light, double depth) {
    const double length = 4 * largest_coordinate(scene, depth);
    Beam beam{scene.camera.eye, {}, {scene.camera.forward}, transform_error * length};
    for (const glm::dvec3& ray : corner_rays(scene.camera)) {
        beam.points.push_back(depth * ray);
        beam.points.push_back(depth * ray + length * to_light);
    }
    for (const glm::dvec3& edge : {scene.camera.right, scene.camera.up})
        beam.axes.push_back(glm::cross(edge, to_light));
    return beam;
}

/// Whether some volume may contain a point of the picture at view depth `depth`. The volume of a
/// triangle contains Q when the line from Q to the light meets the triangle, so a triangle that is
/// separated from all such lines contains none. Axes tried: the beam's face normals and the
/// triangle's own; where they do not separate, the answer is "may".
bool volume_meets(const Scene& scene, double depth) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const Beam beam =
        light.w != 0 ? beam_to_point(scene, light, depth) : beam_along(scene, light, depth);
    const auto is_clear = [&](std::uint32_t triangle) {
        Corners corners = corners_of(scene, triangle);
        for (glm::dvec3& point : corners) point -= beam.origin;
        const auto separates = [&](const glm::dvec3& axis) {
            return are_separated(corners, beam.points, axis, beam.margin);
        };
        return std::any_of(beam.axes.begin(), beam.axes.end(), separates) ||
               separates(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    };
    return some_caster(scene, [&](std::uint32_t triangle) { return !is_clear(triangle); });
}

/// Whether some volume may be seen at infinity: a direction from the light through a triangle is
/// then a direction of the picture as well. The picture's cone lies on the inner side of its four
/// side planes and of the plane across `forward`; a triangle whose three directions lie clearly
/// outside one of them is never seen so far out. The margin is an angle, plus the transform's
/// error at the vertex. All volumes of a directional light run into one point at infinity, where a
/// cap covers nothing.
bool volume_reaches_infinity(const Scene& scene) {
    if (chosen_light(scene).kind == Light::Kind::directional) return false;
    const glm::dvec3 light = chosen_light(scene).position;
    const double error = transform_error * largest_coordinate(scene, scene.camera.near);
    const std::array<glm::dvec3, 4> rays = corner_rays(scene.camera);
    std::array<glm::dvec3, 5> inward{};
    for (std::size_t i = 0; i < 4; ++i) // corners run clockwise as seen from the eye
        inward[i] = glm::normalize(glm::cross(rays[i], rays[(i + 1) % 4]));
    inward[4] = scene.camera.forward;
    const auto is_outside = [&](const Corners& corners, const glm::dvec3& axis) {
        return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& point) {
            const glm::dvec3 direction = point - light;
            return glm::dot(axis, direction) < -(transform_error * glm::length(direction) + error);
        });
    };
    return some_caster(scene, [&](std::uint32_t triangle) {
        const Corners corners = corners_of(scene, triangle);
        return std::none_of(inward.begin(), inward.end(),
                            [&](const glm::dvec3& axis) { return is_outside(corners, axis); });
    });
}

/// A scan may come in thousands of open pieces: so many are listed, the others counted.
constexpr std::size_t most_faults = 20;

std::vector<std::string> list_faults(const Scene& scene, const std::vector<CasterReport>& reports) {
    std::vector<std::string> faults;
    for (const CasterReport& report : reports)
        if (std::string words = words_of(scene, report); !words.empty())
            faults.push_back(std::move(words));
    if (faults.size() <= most_faults) return faults;
    const std::size_t unlisted = faults.size() - most_faults;
    faults.resize(most_faults);
    faults.push_back(
        fmt::format("{} more casters are open, inverted or not two-manifold", unlisted));
    return faults;
}

} // namespace

Plan make_plan(const Scene& scene) {
    Plan plan;
    plan.left_out.push_back("tangents: no normal map is evaluated, visibility only");
    const std::vector<CasterReport> casters = inspect_casters(scene);
    plan.faults = list_faults(scene, casters);
    plan.hole_filling = !std::all_of(casters.begin(), casters.end(),
                                     [](const CasterReport& c) { return c.encloses_volume(); });
    if (!plan.hole_filling) plan.left_out.push_back("hole filling: every caster is closed");
    plan.volume_meets_near = volume_meets(scene, scene.camera.near);
    if (!plan.volume_meets_near)
        plan.left_out.push_back("near cap: no volume meets the near plane, z-pass is enough");
    plan.volume_meets_far = volume_meets(scene, finite_far(scene));
    if (!plan.volume_meets_far)
        plan.left_out.push_back("depth clamp: no volume meets the far plane");
    plan.dark_cap = volume_reaches_infinity(scene);
    if (!plan.dark_cap) plan.left_out.push_back("dark cap: no volume is seen to infinity");
    return plan;
}

} // namespace shadowproof
