#include "scenes/mesh/extrusion.h"

#include "scenes/error.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

double finite_extrusion(const Scene& scene) {
    if (scene.positions.empty()) return 0;
    glm::dvec3 lower = scene.positions.front();
    glm::dvec3 upper = lower;
    for (const glm::dvec3 position : scene.positions) {
        lower = glm::min(lower, position);
        upper = glm::max(upper, position);
    }
    return 0.5 * glm::length(upper - lower);
}

double finite_extrusion(const Scene& scene, const VolumeSettings& asked) {
    if (!asked.extrusion) return finite_extrusion(scene);
    const double distance = *asked.extrusion / scene.unit;
    if (!(distance < 0x1p62))
        throw Error("--extrusion", "is further than coordinates may be", "give a smaller length");
    return distance;
}

std::vector<glm::vec3> extruded_positions(const Scene& scene, double distance) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    std::vector<glm::vec3> extruded;
    extruded.reserve(scene.positions.size());
    for (const glm::dvec3 position : scene.positions) {
        const glm::dvec3 away = light.w * position - glm::dvec3(light);
        const double length = glm::length(away);
        // A vertex in the light itself has no direction to go.
        extruded.emplace_back(length > 0 ? position + away * (distance / length) : position);
    }
    return extruded;
}

} // namespace shadowproof
