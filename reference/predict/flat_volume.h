// Shadow volumes of finite length over casters that touch the light. As all of the caster's corners
// move straight away from the light, the far end lies in the caster's own plane, and the volume
// between the two is empty.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace shadowproof {

struct FlatVolume {
    std::uint32_t triangle = no_triangle;
    bool faces_light = false; ///< else it is not drawn, though its far end may face the light
    glm::dvec3 corner{0, 0, 0};
    glm::dvec3 normal{0, 0, 0}; ///< normalised
    double thickness = 0;       ///< how far its far end is from the plane
};

/// The volumes of the casting triangles whose far end passes the light so closely that rounding
/// moves the planes of its sides. `far_ends`: where positions lie once extruded.
std::vector<FlatVolume> flat_volumes(const Scene& casters, std::span<const glm::vec3> far_ends);

/// The casters without these triangles: triangles without area take their place.
Scene without(Scene casters, std::span<const FlatVolume> volumes);

} // namespace shadowproof
