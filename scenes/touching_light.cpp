#include "scenes/touching_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// Weights of the three corners, that add up to one, of the point of a triangle nearest to the
/// origin: where none of its edges is nearer, the foot of the perpendicular.
glm::dvec3 nearest_to_origin(const std::array<glm::dvec3, 3>& corners) {
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

/// How far a direction from the light comes out of its place, in its own length: subtracting the
/// light as two floats rounds twice; a row of the transform rounds five times the sizes of three
/// terms, at most sqrt(3) of its length, and so in each of three axes; and each of six planes may
/// clip, which divides, subtracts, multiplies and adds once.
constexpr double direction_error = (2 + 5 * 3 + 6 * 4) * 0x1p-24;
/// What two floats leave of the light's position, in its own length.
constexpr double position_error = 0x1p-47;

} // namespace

std::vector<std::uint32_t> triangles_touching_light(const Scene& scene) {
    const Light& light = chosen_light(scene);
    std::vector<std::uint32_t> touching;
    if (light.kind == Light::Kind::directional) return touching;
    const double of_light = position_error * glm::length(light.position);
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < casts.size(); ++triangle) {
        if (casts[triangle] == 0) continue;
        std::array<glm::dvec3, 3> corners;
        glm::dvec3 lengths;
        for (int k = 0; k < 3; ++k) {
            corners[k] = corner(scene, triangle, k) - light.position;
            lengths[k] = glm::length(corners[k]);
        }
        // Cheap, and enough for all but a few: a triangle is no nearer than its size allows.
        const double size =
            std::max(glm::distance(corners[0], corners[1]), glm::distance(corners[0], corners[2]));
        if (lengths[0] > 2 * size + 2 * of_light) continue;
        const glm::dvec3 weights = nearest_to_origin(corners);
        const glm::dvec3 nearest =
            weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
        if (glm::length(nearest) <= direction_error * glm::dot(weights, lengths) + of_light)
            touching.push_back(triangle);
    }
    return touching;
}

} // namespace shadowproof
