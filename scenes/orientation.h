// On which side of a plane a point lies, with a sign that is always right.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace shadowproof {

/// (b - a) x (c - a) . (l - w a): positive where the triangle is wound counter-clockwise as seen
/// from the homogeneous point (l, w), negative where clockwise. The sign is exact, and zero exactly
/// where there is no area or the point lies in the plane; the magnitude is computed in double. All
/// inputs must be finite.
double orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   const glm::dvec4& point);

/// The sign (-1, 0 or 1) of ((w a - l) x (b - a)) . (p - v a): the side of the plane through the
/// edge and the light L = (l, w) on which a homogeneous place (p, v) lies, v being 1 or, of a
/// direction, 0. Exact, with ties broken as if the place were moved by (e, e^2, e^3) with an
/// infinitesimal e (Edelsbrunner & Muecke 1990, Simulation of Simplicity): so counting faces treats
/// a place on an edge like one beside it. Zero only where there is no such plane.
int side_of_edge(const glm::dvec4& light, const glm::dvec3& a, const glm::dvec3& b,
                 const glm::dvec4& place);

/// The sign of (b - a) x (c - a) . (p - v a), ties broken by the same move. Zero only where the
/// triangle has no area.
int side_of_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                     const glm::dvec4& place);

} // namespace shadowproof
