// Coordinates in which all rays to a light run straight up: of a directional light, and of one that
// is so far away that its rays are nearly parallel. Looking along the rays, a ray is a point (u,
// v), a triangle's edge is a line, and occluders are what lies higher.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// A light that is this many times as far away as the scene reaches counts as far. Then
/// |lean| <= 2^-9 where coordinates are at most 1/2.
inline constexpr double far_light = 0x1p12;

/// (u, v, h) of a point q: with z its component along the axis nearest to the light's direction, h
/// is z, and u and v are the two other components, sheared by slopes of at most 1 so that the
/// light's direction becomes (0, 0, |l_z|). Of a light at a distance, all three are divided by
/// 1 - lean z: a projective map, which takes lines to lines and planes to planes, the lines through
/// the light to vertical ones, and the light itself to an infinite height. Points on the scene's
/// side of the light keep their order along such a line. Seen from the light, u and v are such that
/// det(a, b, c) with (u, v, 1) for each corner has the sign of Predicates::side.
struct Shear {
    std::array<int, 3> axes{0, 1, 2}; ///< of the world, for u, v and h
    double slope_u = 0;
    double slope_v = 0;
    double up = 1;   ///< -1 where the light lies towards the negative end of its axis
    double lean = 0; ///< 1 / the light's z; 0 where it is directional

    /// What u, v and h are divided by.
    double divisor(const glm::dvec3& q) const { return 1 - lean * q[axes[2]]; }

    /// Let components of q be known to e and be at most m in size, u = 2^-53.
    ///
    /// Directional: u and v are known to 2 e + 4.1 u m, as the slope is rounded and multiplied
    /// (2 u m), and the difference of at most 2 m rounded (2 u m); h to e.
    ///
    /// Far: the light's place and so the slopes and `lean` are known to 3 u of themselves, which
    /// makes the differences 2 e + 6.1 u m. Where |lean z| <= 1/4, the divisor is at least 3/4 and
    /// known to |lean| e + 2.6 u; u and v, at most 2.7 m, are known to
    ///   4/3 (2 e + 6.1 u m) + 2.7 m (4/3 (|lean| e + 2.6 u) + u) <= 4 e + 21 u m,
    /// and h, at most 4/3 m, to 4/3 e + 4/3 m (4/3 (|lean| e + 2.6 u) + u) <= 2 e + 7 u m.
    glm::dvec3 operator()(const glm::dvec3& q) const {
        const double z = q[axes[2]];
        const glm::dvec3 sheared(q[axes[0]] - slope_u * z, q[axes[1]] - slope_v * z, up * z);
        return sheared / divisor(q);
    }
};

/// `to_light`: the direction to a directional light, not zero; or, where it is `far`, the light's
/// place in the coordinates of the points.
inline Shear shear_along(const glm::dvec3& to_light, bool far) {
    const glm::dvec3 size = glm::abs(to_light);
    const int h = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    Shear shear;
    shear.up = to_light[h] > 0 ? 1 : -1;
    // Towards the positive end u, v, h is left-handed, towards the negative end right-handed.
    const int step = to_light[h] > 0 ? 2 : 1;
    shear.axes = {(h + step) % 3, (h + 2 * step) % 3, h};
    shear.slope_u = to_light[shear.axes[0]] / to_light[h];
    shear.slope_v = to_light[shear.axes[1]] / to_light[h];
    shear.lean = far ? 1 / to_light[h] : 0;
    return shear;
}

} // namespace shadowproof
