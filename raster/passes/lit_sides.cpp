#include "raster/passes/lit_sides.h"

#include <algorithm>

namespace shadowproof {

LitSides lit_sides(const Scene& scene) {
    LitSides sides;
    std::vector<std::uint32_t>& triangles = sides.triangles;
    const std::vector<std::uint8_t> receives = receiving_triangles(scene);
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec4 eye = homogeneous_eye(scene.camera);
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        const double of_light = side(scene, triangle, light);
        const double of_eye = side(scene, triangle, eye);
        if ((of_light > 0 && of_eye > 0) || (of_light < 0 && of_eye < 0))
            triangles.push_back(triangle);
    }
    const auto others =
        std::stable_partition(triangles.begin(), triangles.end(),
                              [&](std::uint32_t triangle) { return receives[triangle] != 0; });
    sides.receivers = static_cast<std::size_t>(others - triangles.begin());
    return sides;
}

} // namespace shadowproof
