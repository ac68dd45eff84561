#include "compare/maps/footprint.h"

#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

struct LightRay {
    glm::dvec3 origin{0, 0, 0};
    glm::dvec3 direction{0, 0, 0};
};

/// Through a place in the face's picture, in texels.
LightRay ray_through(const LightView& light, std::size_t face, const glm::dvec2& place) {
    const Camera& camera = light.camera(face);
    const glm::dvec3 line = line_of_sight(camera, place.x, place.y);
    return {start_of(camera, line), direction_of(camera, line)};
}

} // namespace

glm::dvec2 footprint(const LightView& light, const Scene& scene, const Texel& texel,
                     std::uint32_t triangle) {
    const glm::dvec3 a = corner(scene, triangle, 0);
    const glm::dvec3 normal =
        glm::cross(corner(scene, triangle, 1) - a, corner(scene, triangle, 2) - a);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto met = [&](const glm::dvec2& place, glm::dvec3& point) {
        const LightRay ray = ray_through(light, texel.face, place);
        const double depth = glm::dot(normal, a - ray.origin) / glm::dot(normal, ray.direction);
        point = ray.origin + depth * ray.direction;
        return depth > 0 && depth < infinity;
    };
    const auto length = [&](const glm::dvec2& half) {
        const glm::dvec2 centre(texel.x + 0.5, texel.y + 0.5);
        glm::dvec3 from;
        glm::dvec3 to;
        const bool both = met(centre - half, from) && met(centre + half, to);
        return both ? glm::distance(from, to) : infinity;
    };
    return {length({0.5, 0}), length({0, 0.5})};
}

double width_at(const LightView& light, const Texel& texel, double depth) {
    return 1 / pixels_of_length(light.camera(texel.face), depth);
}

} // namespace shadowproof
