// Colours of a picture by what is truly seen at its pixels.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/load/picture/picture.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <vector>

namespace shadowproof {

/// Groups of surfaces that the light meets at about one angle: the sine of it, in equal parts.
inline constexpr int angle_groups = 24;

/// The sine of the angle at which the light meets a triangle at a point of it; not a number where
/// the point is the light, or the triangle has no area in double.
double sine_to_light(const Scene& scene, std::uint32_t triangle, const glm::dvec3& point);

/// The group of a sine; 0 where it is not a number.
int angle_group(double sine);

/// Of gray pictures, three times the gray.
glm::dvec3 color_at(const Picture& picture, std::size_t pixel);

/// What decides a pixel's colour in a picture of plain surfaces: mesh, angle group and visibility,
/// as one number; background is 0.
std::uint32_t color_label(const Scene& scene, const RayTruth& seen, const glm::dvec3& line);

/// A label's pixels: the median of each channel.
glm::dvec3 median_color(std::vector<glm::dvec3>& colors);

} // namespace shadowproof
