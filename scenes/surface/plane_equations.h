// Tangents of one textured triangle from plane equations, after M. Kilgard, "A Practical and Robust
// Bump-mapping Technique for Today's GPUs" (2000), for skins of polygon models.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// Over a triangle x, y and z are linear in the texture coordinates (s, t): the corners (x, s, t)
/// span a plane, and so do (y, s, t) and (z, s, t):
///
///     A x + B0 s + C0 t + D0 = 0,   A y + B1 s + C1 t + D1 = 0,   A z + B2 s + C2 t + D2 = 0
///
/// (A, B, C) is the cross product of the edges from the first corner, (dx, ds, dt) and
/// (dx', ds', dt'):
///
///     A = ds dt' - dt ds',   B = dt dx' - dx dt',   C = dx ds' - ds dx'
///
/// x has no part in A: it is twice the triangle's area in the texture, the same in all three
/// planes. Products of coordinates are summed as written, so small integers stay exact.
struct PlaneEquations {
    double a = 0;
    glm::dvec3 b{0, 0, 0};
    glm::dvec3 c{0, 0, 0};
    glm::dvec3 d{0, 0, 0};
};

PlaneEquations plane_equations(const std::array<glm::dvec3, 3>& positions,
                               const std::array<glm::dvec2, 3>& at);

/// The directions in which s and t grow, normalised; correct for mirrored pictures too.
struct TextureDirections {
    glm::dvec3 along_s{0, 0, 0};
    glm::dvec3 along_t{0, 0, 0};
};

/// At a fixed t, A dx + B0 ds = 0: the directions are those of
///
///     d(x, y, z)/ds = (-B0/A, -B1/A, -B2/A),   d(x, y, z)/dt = (-C0/A, -C1/A, -C2/A)
///
/// Only the sign of A matters to a unit vector: -B over its length, negated where A < 0. So a
/// picture and its mirror image, whose A differ in sign, both get correct tangents.
/// (With t down the picture as in glTF, the upright one is that with A < 0, as seen from where the
/// corners are counter-clockwise.) Zero where the triangle has no area in the texture (A = 0), or a
/// derivative no length.
TextureDirections directions_of(const PlaneEquations& planes);

/// Between two key frames, corners go straight and texture coordinates stay: A, which these alone
/// make, stays too, and B, C and D are sums of products of one coordinate that moves and one that
/// does not, so they are linear in time. Hence mix(p, q, share) is, term for term, what
/// plane_equations says of the corners at that time; the directions divide by a length and are not
/// linear: interpolating those of two key frames gives others.
PlaneEquations mix(const PlaneEquations& from, const PlaneEquations& to, double share);

} // namespace shadowproof
