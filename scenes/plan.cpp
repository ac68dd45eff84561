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
    include(chosen_light(scene).position);
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

/// Whether some volume may contain a point of the picture at view depth `depth`. The volume of a
/// triangle contains Q when the segment from Q to the light meets the triangle, so a triangle that
/// is separated from the convex hull of rectangle and light contains none. Axes tried: the hull's
/// five face normals and the triangle's own; where they do not separate, the answer is "may". A
/// light in the rectangle's plane flattens the hull, which the axes survive.
bool volume_meets(const Scene& scene, double depth) {
    const glm::dvec3 light = chosen_light(scene).position;
    const double margin = transform_error * largest_coordinate(scene, depth);
    std::array<glm::dvec3, 5> hull{}; // relative to the light, which is its last point
    const std::array<glm::dvec3, 4> rays = corner_rays(scene.camera);
    for (std::size_t i = 0; i < 4; ++i) hull[i] = scene.camera.eye + depth * rays[i] - light;
    std::array<glm::dvec3, 5> axes{};
    for (std::size_t i = 0; i < 4; ++i) axes[i] = glm::cross(hull[i], hull[(i + 1) % 4]);
    axes[4] = scene.camera.forward;
    const auto is_clear = [&](std::uint32_t triangle) {
        Corners corners = corners_of(scene, triangle);
        for (glm::dvec3& point : corners) point -= light;
        const auto separates = [&](const glm::dvec3& axis) {
            return are_separated(corners, hull, axis, margin);
        };
        return std::any_of(axes.begin(), axes.end(), separates) ||
               separates(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    };
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        if (!is_clear(triangle)) return true;
    return false;
}

/// Whether some volume may be seen at infinity: a direction from the light through a triangle is
/// then a direction of the picture as well. The picture's cone lies on the inner side of its four
/// side planes and of the plane across `forward`; a triangle whose three directions lie clearly
/// outside one of them is never seen so far out. The margin is an angle, plus the transform's
/// error at the vertex.
bool volume_reaches_infinity(const Scene& scene) {
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
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        const Corners corners = corners_of(scene, triangle);
        if (std::none_of(inward.begin(), inward.end(),
                         [&](const glm::dvec3& axis) { return is_outside(corners, axis); }))
            return true;
    }
    return false;
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
    // A directional light has no position to make a hull with: nothing is claimed for it.
    if (chosen_light(scene).kind == Light::Kind::directional) return plan;
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
