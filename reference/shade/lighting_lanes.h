// The purely arithmetic steps of shading.h, for sixteen points at a time. Uses the widest vectors
// that the processor has; the result is the same with any, since + - * / and square roots are
// correctly rounded by all of them and no product is fused with a sum.
#pragma once

#include "reference/trace/packet.h"
#include "scenes/scene.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace shadowproof {

struct LaneVectors {
    alignas(64) Lanes<double> x{}, y{}, z{};

    void set(std::size_t lane, const glm::dvec3& v) {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
    glm::dvec3 at(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
};

/// The light, the same for all points.
struct LaneLight {
    glm::dvec4 to{0, 0, 0, 1}; ///< homogeneous, a place less the eye; normalised where w is 0
    glm::dvec3 axis{0, 0, -1}; ///< of a spot
    bool spot = false;
    double cos_outer = 0;
    double cone_scale = 0; ///< as SpotCone::scale
    bool inverse_square = false;
    Highlight highlight{};
};

/// Unused lanes may hold any values.
struct LightingLanes {
    // Given:
    LaneVectors direction;                ///< D
    LaneVectors point;                    ///< Q
    LaneVectors tangent;                  ///< as interpolated
    LaneVectors bump;                     ///< m, of any length
    LaneVectors gradient;                 ///< G of heights in units of space
    alignas(64) Lanes<double> in_space{}; ///< 1 where G counts instead of m, else 0
    alignas(64) Lanes<double> hand{};
    alignas(64) Lanes<double> side{}; ///< -1 where the eye sees the back
    // Given as interpolated, not of length zero, and replaced by N, towards the visible side:
    LaneVectors normal;
    // Computed:
    LaneVectors bumped; ///< N', towards the visible side
    LaneVectors to_light;
    LaneVectors half;
    alignas(64) Lanes<double> strength{}; ///< of the light, by cone and distance
    alignas(64) Lanes<double> self_shadow_light{};
    alignas(64) Lanes<double> self_shadow_half{};
    alignas(64) Lanes<double> diffuse{};
    alignas(64) Lanes<double> specular{};
};

void light_lanes(const LaneLight& light, LightingLanes& lanes);

} // namespace shadowproof
