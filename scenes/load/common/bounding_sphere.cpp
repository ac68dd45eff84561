#include "scenes/load/common/bounding_sphere.h"

#include "scenes/error.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

Sphere bounding_sphere(const Scene& scene) {
    glm::dvec3 low = scene.positions.front();
    glm::dvec3 high = low;
    for (const glm::dvec3 position : scene.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    Sphere sphere{low * 0.5 + high * 0.5, 0};
    for (const glm::dvec3 position : scene.positions)
        sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, position));
    if (!(sphere.radius > 0))
        throw Error(scene.file.string(), "all vertices lie at one point, so nothing can be framed",
                    "add a camera and a light");
    return sphere;
}

} // namespace shadowproof
