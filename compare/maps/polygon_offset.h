// By how much OpenGL's polygon offset moves a triangle's window depths, as far as a driver is free
// to compute it: a factor times the slope of its plane over the picture, and units of what the
// depth format resolves.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "compare/driver/plane_at_pixel.h"
#include "scenes/shadow_map.h"

#include <vector>

namespace shadowproof {

/// Of window depth.
struct PolygonOffset {
    double own = 0; ///< by the exact plane, whose slope is the larger of both axes'
    double least = 0;
    double most = 0; ///< infinite where it is seen edge-on, as far as can be told
};

/// That of a texel. `polygon`: what clipping leaves of the triangle; of the triangles that it is
/// drawn as, those count that may hold the texel's centre `place`, or all where none does. `unit`:
/// the driver's. `window`: how a point's key gives its window depth. `reach`: how far each of its
/// corners may be snapped, in texels. No offset where the model asks for none.
PolygonOffset polygon_offset(const std::vector<PicturePoint>& polygon, const glm::dvec2& place,
                             const MapModel& model, const OffsetUnit& unit,
                             const WindowDepth& window, double reach);

} // namespace shadowproof
