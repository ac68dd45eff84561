#include "compare/driver/interpolated.h"

#include "scenes/driver.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// One value per corner.
template <class T>
using ThreeOf = std::array<T, 3>;

template <class T>
T blend(const glm::dvec3& weights, const ThreeOf<T>& values) {
    return weights.x * values[0] + weights.y * values[1] + weights.z * values[2];
}

/// Largest distance from `middle` of a vector with these values at the corners: no place of the
/// polygon is further from it than its furthest corner.
double off_by(const ThreeOf<glm::dvec3>& values, const glm::dvec3& middle,
              const PixelSpread& spread) {
    if (spread.share == 0 && !spread.aside) return 0;
    double off = 0;
    if (spread.aside)
        for (const glm::dvec3& weights : spread.corners)
            off = std::max(off, glm::distance(blend(weights, values), middle));
    const double largest =
        std::max({glm::length(values[0]), glm::length(values[1]), glm::length(values[2])});
    return off + spread.share * largest;
}

/// Texture coordinates. Finding a place among the texels rounds it four times more: brought into
/// one period, which is up to 2 long, times their number, less a half, and what is left above the
/// texel.
PlaceRange place_range(const ThreeOf<glm::dvec2>& values, const PixelSpread& spread) {
    PlaceRange range = range_of(blend(spread.middle, values));
    if (spread.share == 0 && !spread.aside) return range;
    if (spread.aside)
        for (const glm::dvec3& corner : spread.corners)
            range = hull(range, range_of(blend(corner, values)));
    const glm::dvec2 largest =
        glm::max(glm::abs(values[0]), glm::max(glm::abs(values[1]), glm::abs(values[2])));
    for (int k = 0; k < 2; ++k) {
        Interval& axis = range[static_cast<std::size_t>(k)];
        axis = widened(axis, spread.share * largest[k] + 4 * 2 * v);
    }
    return range;
}

template <class Of>
auto at_corners(const Of& of) {
    return ThreeOf<decltype(of(0))>{of(0), of(1), of(2)};
}

} // namespace

glm::dvec3 weights_along(const Scene& scene, std::uint32_t triangle, const glm::dvec3& line) {
    const glm::dvec3& direction = direction_of(scene.camera, line);
    const glm::dvec3 first = corner(scene, triangle, 0);
    const glm::dvec3 a = first - start_of(scene.camera, line);
    const glm::dvec3 e = corner(scene, triangle, 1) - first;
    const glm::dvec3 f = corner(scene, triangle, 2) - first;
    const double all = glm::dot(direction, glm::cross(e, f));
    const double b = glm::dot(direction, glm::cross(f, a)) / all;
    const double c = glm::dot(direction, glm::cross(a, e)) / all;
    return {1 - b - c, b, c};
}

Interpolated interpolated_at(const Scene& scene, std::uint32_t triangle,
                             std::span<const Surface, 3> corners, const PixelSpread& spread) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const Camera& camera = scene.camera;
    const glm::dvec3& eye = camera.eye;
    const Surface* surface = corners.data();
    const auto places = at_corners([&](int k) { return corner(scene, triangle, k) - eye; });
    const auto way_from_eye = [&](const glm::dvec3& place) {
        return camera.is_orthographic() ? camera.forward : place;
    };
    const auto from_eye =
        at_corners([&](int k) { return way_from_eye(places[static_cast<std::size_t>(k)]); });
    const auto way_to = [&](const glm::dvec3& place) {
        return (glm::dvec3(light) - light.w * eye) - light.w * place;
    };
    const auto to_light =
        at_corners([&](int k) { return way_to(places[static_cast<std::size_t>(k)]); });
    const auto normals = at_corners([&](int k) { return glm::dvec3(surface[k].normal); });
    const auto tangents =
        at_corners([&](int k) { return glm::dvec3(glm::vec3(surface[k].tangent)); });
    Interpolated at;
    const glm::dvec3 place = blend(spread.middle, places);
    at.from_eye = way_from_eye(place);
    at.to_light = way_to(place);
    at.normal = blend(spread.middle, normals);
    at.tangent = blend(spread.middle, tangents);
    at.from_eye_off = off_by(from_eye, at.from_eye, spread);
    at.to_light_off = off_by(to_light, at.to_light, spread);
    at.normal_off = off_by(normals, at.normal, spread);
    at.tangent_off = off_by(tangents, at.tangent, spread);
    const auto bumps_at = at_corners([&](int k) { return glm::dvec2(surface[k].bump_at); });
    const auto decals_at = at_corners([&](int k) { return glm::dvec2(surface[k].decal_at); });
    at.bump_at = place_range(bumps_at, spread);
    at.decal_at = place_range(decals_at, spread);
    if (!spread.quad) return at;
    at.bump_steps = quad_steps(scene, triangle, bumps_at, *spread.quad);
    at.decal_steps = quad_steps(scene, triangle, decals_at, *spread.quad);
    return at;
}

} // namespace shadowproof
