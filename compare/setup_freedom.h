// How far off a rasterizer may set up the plane of a face's depths over the picture. Fine meshes
// throw long and thin sides, whose planes a rounding of their slopes turns far more than it would a
// well-shaped triangle's. So with whatever else is interpolated.
#pragma once

#include "compare/clipped_polygon.h"
#include "reference/ledger.h"
#include "scenes/scene.h"

#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// A pixel as a face covers it.
struct CoveredPixel {
    glm::dvec3 direction{0, 0, 0}; ///< of its centre's ray
    double reach = 0;              ///< pixels by which a face may be drawn aside
    Drawing drawing;
};

/// Error of the inverse of a triangle's view depth at a pixel. Infinite where the triangle is seen
/// edge-on, as then any slope may come out.
double setup_freedom(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel);

/// The same for a side of a volume. `far_ends`: where the casters' positions lie once extruded,
/// null where that is at infinity.
double setup_freedom(const Scene& casters, const std::vector<glm::vec3>* far_ends,
                     const Crossing& side, const CoveredPixel& pixel);

/// Error of anything that is interpolated over a triangle, in perspective, at a pixel: as a share
/// of its size at the corner where it is largest. Infinite where the triangle is seen edge-on.
double attribute_freedom(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel);

} // namespace shadowproof
