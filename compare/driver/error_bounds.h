// Error bounds of a rasterizer that conforms to OpenGL: how far aside it may draw a face, and how
// far off the face's depth may be. Derived from the driver's snapping, the depth format and the
// roundings of floats, term by term; never tuned.
#pragma once

#include "scenes/driver.h"
#include "scenes/frame.h"
#include "scenes/scene.h"

#include <glm/vec3.hpp>

namespace shadowproof {

/// Roundings of window depth between two faces that are compared: see stored_depth_error.
inline constexpr double depth_roundings = 2 * window_depth_roundings * float_roundoff;

/// How far, in pixels, the rasterizer may move what it draws at a world point sideways: half a
/// step of the snapping grid, and the float transform's error.
double lateral_error(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point);

/// How far apart, in view depth, two faces at a depth may be and yet be stored in either order by
/// the roundings of window depth alone. What their corners are off by is setup_error's.
double stored_depth_error(const DepthModel& depth_model, double depth);

/// The same by the float transform, at a world point near which their corners lie: ten roundings
/// for two faces.
double transform_depth_error(const Scene& scene, const DepthModel& depth_model,
                             const glm::dvec3& point);

/// Both together.
double depth_error(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point);

} // namespace shadowproof
