#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

double sine_to_light(const Scene& scene, std::uint32_t triangle, const glm::dvec3& point) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec3 to_light = glm::dvec3(light) - light.w * point;
    const glm::dvec3 normal = glm::cross(corner(scene, triangle, 1) - corner(scene, triangle, 0),
                                         corner(scene, triangle, 2) - corner(scene, triangle, 0));
    return std::abs(glm::dot(normal, to_light)) / (glm::length(normal) * glm::length(to_light));
}

int angle_group(double sine) {
    return sine > 0 ? std::min(static_cast<int>(sine * angle_groups), angle_groups - 1) : 0;
}

glm::dvec3 color_at(const Picture& picture, std::size_t pixel) {
    const auto channels = static_cast<std::size_t>(picture.channels);
    const float* const values = picture.values.data() + pixel * channels;
    if (channels < 3) return glm::dvec3(values[0]);
    return {values[0], values[1], values[2]};
}

std::uint32_t color_label(const Scene& scene, const RayTruth& seen, const glm::dvec3& line) {
    if (seen.triangle == no_triangle) return 0;
    const glm::dvec3 point = point_on(scene.camera, line, seen.depth);
    const auto group =
        static_cast<std::uint32_t>(angle_group(sine_to_light(scene, seen.triangle, point)));
    const std::uint32_t lit = seen.visibility == Visibility::lit ? 1 : 0;
    return 1 + 2 * (angle_groups * mesh_of(scene, seen.triangle) + group) + lit;
}

glm::dvec3 median_color(std::vector<glm::dvec3>& colors) {
    glm::dvec3 median(0);
    const auto middle = colors.begin() + std::ssize(colors) / 2;
    for (int k = 0; k < 3; ++k) {
        std::nth_element(colors.begin(), middle, colors.end(),
                         [k](const glm::dvec3& a, const glm::dvec3& b) { return a[k] < b[k]; });
        median[k] = (*middle)[k];
    }
    return median;
}

} // namespace shadowproof
