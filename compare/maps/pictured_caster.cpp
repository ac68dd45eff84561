#include "compare/maps/pictured_caster.h"

#include "compare/driver/setup_error.h"
#include "scenes/driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// Clip coordinates are made of a point relative to the eye, which rounds twice; of a matrix whose
/// entries are rounded, a product each, and three sums: 7 v of the terms. Depth has a constant
/// term, which is not multiplied: 4 v of it. The eye is a sum of two floats, of which the second is
/// subtracted as rounded as the first.
ViewCorner clip_corner(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec3 relative = point - camera.eye;
    const double depths = camera.far - camera.near;
    const std::array<glm::dvec3, 3> rows{camera.right / camera.half_height,
                                         camera.up / camera.half_height,
                                         camera.forward * (2 / depths)};
    const glm::dvec3 constant(0, 0, (camera.far + camera.near) / depths);
    ViewCorner corner;
    corner.at.w = 1;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3& row = rows[static_cast<std::size_t>(k)];
        corner.at[k] = glm::dot(row, relative) - constant[k];
        corner.error[k] = 7 * v * glm::dot(glm::abs(row), glm::abs(relative)) +
                          4 * v * constant[k] +
                          2 * two_floats_roundoff * glm::dot(glm::abs(row), glm::abs(camera.eye));
    }
    return corner;
}

/// The division by w, which is 1, the viewport's product and its sum round a place.
PicturePoint pictured(const Camera& camera, const ViewCorner& corner) {
    const double half = 0.5 * camera.width;
    PicturePoint point{.place = {(1 + corner.at.x) * half, (1 - corner.at.y) * half},
                       .key = 0.5 * corner.at.z + 0.5,
                       .made_by_clipping = corner.made_by_clipping};
    const double pixels =
        std::max({std::abs(point.place.x), std::abs(point.place.y), 1.0 * camera.width});
    point.place_error = std::max(corner.error.x, corner.error.y) * half + 3 * v * pixels;
    point.depth_error = 0.5 * corner.error.z + window_depth_roundings * v;
    return point;
}

} // namespace

std::vector<PicturePoint> pictured_in_parallel(const Scene& scene, const Camera& camera,
                                               std::uint32_t triangle) {
    std::vector<ViewCorner> polygon;
    for (int k = 0; k < 3; ++k) polygon.push_back(clip_corner(camera, corner(scene, triangle, k)));
    const auto clip = [&](const ClipFunction& function) {
        if (!std::ranges::all_of(polygon, [&](const ViewCorner& c) { return function(c) >= 0; }))
            polygon = clipped(polygon, function, {});
    };
    clip([](const ViewCorner& c) { return 1 + c.at.z; });
    clip([](const ViewCorner& c) { return 1 - c.at.z; });
    std::vector<PicturePoint> points;
    points.reserve(polygon.size());
    for (const ViewCorner& c : polygon) points.push_back(pictured(camera, c));
    return points;
}

// Of the triangles that may cover the place the largest, or of all if none does.
double window_depth_error(const std::vector<PicturePoint>& polygon, const glm::dvec2& place,
                          double reach) {
    double covering = -1;
    double any = 0;
    for (const std::array<PicturePoint, 3>& triangle : fan_of(polygon)) {
        const double error = setup_error(triangle, place, reach);
        any = std::max(any, error);
        if (may_hold({triangle.begin(), triangle.end()}, place, std::numbers::sqrt2 * reach))
            covering = std::max(covering, error);
    }
    return covering < 0 ? any : covering;
}

bool may_be_flipped(const std::vector<PicturePoint>& polygon, double reach) {
    return std::ranges::any_of(fan_of(polygon), [&](const std::array<PicturePoint, 3>& triangle) {
        return may_be_flipped(triangle, reach);
    });
}

} // namespace shadowproof
