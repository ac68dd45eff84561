// Casters so near the light that float arithmetic, as in a graphics pipeline, cannot tell on which
// side of them it is.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// The point of a triangle that is nearest to the origin.
glm::dvec3 nearest_to_origin(const std::array<glm::dvec3, 3>& corners);

/// Whether the directions from the light to a triangle's corners may surround the light once each
/// is off by float rounding, or once a clipper cuts them. Which half of the sky the
/// triangle then covers, as seen from the light, depends on rounding; or a strip of the picture is
/// lost. Never true for a directional light.
bool touches_light(const Scene& scene, std::uint32_t triangle);

/// The same for an edge between two positions.
bool edge_touches_light(const Scene& scene, std::uint32_t a, std::uint32_t b);

/// Whether a position is so near the light that their difference is less accurate than a float, if
/// computed in floats with the light given as a sum of two.
bool is_lost_in_floats(const Scene& scene, std::uint32_t position);

/// Whether a triangle is too far away for any of the above to hold: a quick test.
bool is_far_from_light(const Scene& scene, std::uint32_t triangle);

/// Whether a triangle comes nearer to the light than what float rounding and clipping displace its
/// furthest corner by, relative to the light, and yet does not touch it: as one does that has a
/// corner next to the light.
bool almost_touches_light(const Scene& scene, std::uint32_t triangle);

/// Whether casters come so near the light that places relative to the eye keep less than 12 bits of
/// their directions from the light.
bool casters_near_light(const Scene& scene);

/// The casting triangles that touch the light, in ascending order.
std::vector<std::uint32_t> triangles_touching_light(const Scene& scene);

} // namespace shadowproof
