// What OpenGL makes of a triangle under a camera in parallel projection: its picture, clipped by
// the near and far planes, the window depths over it, and the bounds of both. A sun's map has a
// margin around all casters, so that its borders cut none.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "scenes/scene.h"
#include "scenes/shadow_map.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowproof {

/// The convex polygon that clipping leaves of a triangle, as it is drawn into a sun's map. The
/// member `key` of its points is their window depth, which is what is linear over a
/// picture in parallel projection, and `depth_error` is that of it. Empty where nothing is left.
std::vector<PicturePoint> pictured_in_parallel(const Scene& scene, const Camera& camera,
                                               std::uint32_t triangle);

/// Error of the polygon's window depth at a place of the picture, which it may cover when it is
/// drawn `reach` pixels aside: of its corners' and of the set-up of the triangles that it is drawn
/// as. Infinite where it is seen edge-on.
double window_depth_error(const std::vector<PicturePoint>& polygon, const glm::dvec2& place,
                          double reach);

/// Whether its corners' errors, and snapping by up to `reach` along each axis, may reverse the
/// winding of one of these triangles.
bool may_be_flipped(const std::vector<PicturePoint>& polygon, double reach);

} // namespace shadowproof
