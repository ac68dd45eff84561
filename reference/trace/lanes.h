// What doubles tell of up to sixteen rays at once: which come near a box, and which certainly meet
// a triangle, or certainly do not. Uses the widest vectors that the processor has; what the callers
// decide is the same with any.
#pragma once

#include "reference/trace/any_rays.h"
#include "reference/walk/clusters.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace shadowproof {

/// The rays as boxes see them: a plane at b is met at t = (b - origin) * inverse, give or take
/// margin. All components of directions are at least least_component.
struct Slabs {
    alignas(64) std::array<Lanes<double>, 3> inverse{};
    alignas(64) std::array<Lanes<double>, 3> margin{};
};

/// `enlargement`: by how much boxes are enlarged for the ray.
void set_slabs(Slabs& slabs, int lane, const AnyRay& ray, const glm::dvec3& enlargement);

/// One bit per lane whose ray comes near the box, within its limits.
std::uint32_t lanes_near(const AnyRays& rays, const Slabs& slabs, const Box& box);

/// What doubles tell of rays and a triangle, limits apart: one bit per lane.
struct LanesBeside {
    std::uint32_t through = 0; ///< the ray certainly passes through the triangle's inside
    std::uint32_t beside = 0;  ///< it certainly does not meet the closed triangle
};
LanesBeside lanes_beside(const AnyRays& rays, const Corners& t);

} // namespace shadowproof
