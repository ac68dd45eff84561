// By how much OpenGL's polygon offset moves a triangle's window depths, as far as a driver is free
// to compute it: a factor times the slope of its plane over the picture.
#pragma once

#include "compare/driver/clipped_polygon.h"

#include <vector>

namespace shadowproof {

/// Of window depth.
struct SlopeOffset {
    double own = 0; ///< by the exact plane, whose slope is the larger of both axes'
    double least = 0;
    double most = 0; ///< infinite where it is seen edge-on, as far as can be told
};

/// `polygon`: what clipping leaves of the triangle; its `inverse_depth` times `scale` is the window
/// depth, but for a constant. `reach`: how far each of its corners may be snapped, in texels.
SlopeOffset slope_offset(const std::vector<PicturePoint>& polygon, double factor, double scale,
                         double reach);

} // namespace shadowproof
