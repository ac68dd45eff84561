#include "scenes/mesh/touching_light.h"

#include "scenes/driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// Weights of the three corners, with sum 1, for the point of a triangle nearest to the origin: the
/// foot of the perpendicular, unless an edge is nearer.
glm::dvec3 weights_of_nearest(const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double area = glm::dot(normal, normal);
    glm::dvec3 weights;
    for (int k = 0; k < 3; ++k)
        weights[k] =
            glm::dot(glm::cross(corners[(k + 1) % 3], corners[(k + 2) % 3]), normal) / area;
    if (area > 0 && weights.x >= 0 && weights.y >= 0 && weights.z >= 0) return weights;
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3& from = corners[k];
        const glm::dvec3 along = corners[(k + 1) % 3] - from;
        const double squared = glm::dot(along, along);
        const double t = squared > 0 ? std::clamp(-glm::dot(from, along) / squared, 0.0, 1.0) : 0;
        const double distance = glm::length(from + t * along);
        if (distance >= nearest) continue;
        nearest = distance;
        weights = glm::dvec3(0);
        weights[k] = 1 - t;
        weights[(k + 1) % 3] = t;
    }
    return weights;
}

} // namespace

glm::dvec3 nearest_to_origin(const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 weights = weights_of_nearest(corners);
    return weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
}

namespace {

/// The error of a direction from the light, relative to its length: subtracting the light as two
/// floats rounds twice; a row of the transform rounds five times the sizes of three terms, at most
/// sqrt(3) of its length, and so in each of three axes; and each of six planes may clip, which
/// divides, subtracts, multiplies and adds once.
constexpr double direction_error =
    (2 + 3 * transform_roundings + 6 * clipping_roundings) * float_roundoff;

/// By how much more a point at infinity may be off where a clipper cuts it than where it is drawn.
/// A border of the picture cuts x at w, which is the picture's half extent h times the depth z; x
/// and w are off by 1 + h. What is lost of the picture is that over h z of its half, and all of it
/// at the growth. z is at least the point's size over that of the picture's longest ray.
double clipping_growth(const Camera& camera) {
    const glm::dvec2 half = half_extent(camera);
    const double least = std::min(half.x, half.y);
    return std::max((1 + least) * std::sqrt(1 + glm::dot(half, half)) / least, 1.0);
}

/// The error of the light's position given as two floats, relative to its length.
constexpr double position_error = two_floats_roundoff;
double error_of_light(const Light& light) {
    return position_error * glm::length(light.position);
}
/// Nearer than this, relative to the same length, position_error exceeds the rounding of a
/// difference to float.
constexpr double near_enough_to_be_lost = position_error / float_roundoff;

} // namespace

bool is_far_from_light(const Scene& scene, std::uint32_t triangle) {
    const Light& light = chosen_light(scene);
    const glm::dvec3 a = corner(scene, triangle, 0);
    const double size = std::max(glm::distance(a, corner(scene, triangle, 1)),
                                 glm::distance(a, corner(scene, triangle, 2)));
    return glm::distance(a, light.position) >
           2 * size + 2 * near_enough_to_be_lost * glm::length(light.position);
}

bool touches_light(const Scene& scene, std::uint32_t triangle) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional || is_far_from_light(scene, triangle)) return false;
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 lengths;
    for (int k = 0; k < 3; ++k) {
        corners[k] = corner(scene, triangle, k) - light.position;
        lengths[k] = glm::length(corners[k]);
    }
    const glm::dvec3 weights = weights_of_nearest(corners);
    const glm::dvec3 nearest =
        weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
    return glm::length(nearest) <=
           clipping_growth(scene.camera) * direction_error * glm::dot(weights, lengths) +
               error_of_light(light);
}

bool almost_touches_light(const Scene& scene, std::uint32_t triangle) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional || touches_light(scene, triangle)) return false;
    std::array<glm::dvec3, 3> corners;
    double furthest = 0;
    for (int k = 0; k < 3; ++k) {
        corners[k] = corner(scene, triangle, k) - light.position;
        furthest = std::max(furthest, glm::length(corners[k]));
    }
    return glm::length(nearest_to_origin(corners)) <=
           clipping_growth(scene.camera) * direction_error * furthest;
}

bool edge_touches_light(const Scene& scene, std::uint32_t a, std::uint32_t b) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional) return false;
    const glm::dvec3 from = glm::dvec3(scene.positions[a]) - light.position;
    const glm::dvec3 to = glm::dvec3(scene.positions[b]) - light.position;
    const glm::dvec3 along = to - from;
    const double squared = glm::dot(along, along);
    const double t = squared > 0 ? std::clamp(-glm::dot(from, along) / squared, 0.0, 1.0) : 0;
    const double lengths = (1 - t) * glm::length(from) + t * glm::length(to);
    return glm::length(from + t * along) <=
           clipping_growth(scene.camera) * direction_error * lengths + error_of_light(light);
}

bool is_lost_in_floats(const Scene& scene, std::uint32_t position) {
    const Light& light = chosen_light(scene);
    return light.kind != Light::Kind::directional &&
           glm::distance(glm::dvec3(scene.positions[position]), light.position) <=
               near_enough_to_be_lost * glm::length(light.position);
}

// Relative to the eye, a place and the light are off by 7 v of their distance from it together.
bool casters_near_light(const Scene& scene) {
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::directional) return false;
    const double near =
        0x1p12 * 7 * float_roundoff * glm::distance(light.position, scene.camera.eye);
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < casts.size(); ++triangle) {
        if (casts[triangle] == 0) continue;
        const auto from_light = [&](int k) { return corner(scene, triangle, k) - light.position; };
        const glm::dvec3 nearest = nearest_to_origin({from_light(0), from_light(1), from_light(2)});
        if (glm::length(nearest) <= near || touches_light(scene, triangle)) return true;
    }
    return false;
}

std::vector<std::uint32_t> triangles_touching_light(const Scene& scene) {
    std::vector<std::uint32_t> touching;
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < casts.size(); ++triangle)
        if (casts[triangle] != 0 && touches_light(scene, triangle)) touching.push_back(triangle);
    return touching;
}

} // namespace shadowproof
