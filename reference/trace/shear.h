// Coordinates in which all rays of a directional light run straight up. A ray is then a point (u,
// v) of the ground, a triangle's edge a line there, and occluders are what stands higher.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// (u, v, h) of a vector: h is its component along the axis nearest to the light's direction, u and
/// v are the two others, sheared by slopes of at most 1 so that the light's direction becomes
/// (0, 0, |l_h|). Seen from the light, u and v are such that det(a, b, c) with (u, v, 1) for each
/// corner has the sign of Predicates::side.
struct Shear {
    std::array<int, 3> axes{0, 1, 2}; ///< of the world, for u, v and h
    double slope_u = 0;
    double slope_v = 0;
    double up = 1; ///< -1 where the light lies towards the negative end of its axis

    /// With components of q known to e and at most m in size, u and v are known to
    /// 2 e + 4.1 u m, u = 2^-53: the slope is rounded and multiplied (2 u m), the difference of at
    /// most 2 m rounded (2 u m).
    glm::dvec3 operator()(const glm::dvec3& q) const {
        const double h = q[axes[2]];
        return {q[axes[0]] - slope_u * h, q[axes[1]] - slope_v * h, up * h};
    }
};

/// `to_light` must not be zero.
inline Shear shear_along(const glm::dvec3& to_light) {
    const glm::dvec3 size = glm::abs(to_light);
    const int h = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    Shear shear;
    shear.up = to_light[h] > 0 ? 1 : -1;
    // Towards the positive end u, v, h is left-handed, towards the negative end right-handed.
    const int step = to_light[h] > 0 ? 2 : 1;
    shear.axes = {(h + step) % 3, (h + 2 * step) % 3, h};
    shear.slope_u = to_light[shear.axes[0]] / to_light[h];
    shear.slope_v = to_light[shear.axes[1]] / to_light[h];
    return shear;
}

} // namespace shadowproof
