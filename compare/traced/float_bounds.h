// What Embree's float arithmetic may report for one ray and one triangle. Its answer differs from
// the exact one only where a number that it compares is nearer to zero than its rounding errors.
#pragma once

#include "reference/trace/any_rays.h"
#include "reference/trace/view.h"
#include "scenes/roundoff.h"

#include <cstdint>

namespace shadowproof {

/// Whether Embree reports that a ray meets a triangle.
enum class Meeting : std::uint8_t {
    never,
    perhaps, ///< its rounding decides
    always,
};

struct FloatMeeting {
    Meeting meeting = Meeting::never;
    double t = 0;                  ///< where; of a meeting that is not ruled out
    double t_error = 0;            ///< within which Embree's t lies
    glm::dvec2 weight_error{0, 0}; ///< the same of the second and third corner's weights
};

/// By how much Embree's traversal may misplace the sides of boxes, as a share of the coordinates
/// there (find_nearby). A side at b is met at (b - o) / d, computed as fl(b r - fl(o r)) or
/// fl(fl(b - o) r), with r a reciprocal. With u = 2^-24, r is off by at most 3.3 u, |b - o| times
/// that; fl(o r) by u |o|; the last operation by u |b - o|: together less than 5.3 u (|b| + |o|).
/// What the rounding of components below least_component adds is less than 2^-53 of the largest
/// coordinate.
inline constexpr double traversal_share = 8 * float_roundoff;

/// What Embree may report of a ray, whose numbers must be floats, and the triangle with corners
/// `t`. `enlargement`: by how much its traversal may misplace the sides of boxes along each axis
/// (traversal_share). `perhaps` wherever a product of its floats may overflow.
FloatMeeting float_meeting(const AnyRay& ray, const Corners& t, const glm::dvec3& enlargement);

/// The same of a triangle of the scene, whose mask, if it has one, is read in float where the ray
/// meets it.
FloatMeeting float_meeting(const Tracer& tracer, const AnyRay& ray, std::uint32_t triangle,
                           const glm::dvec3& enlargement);

} // namespace shadowproof
