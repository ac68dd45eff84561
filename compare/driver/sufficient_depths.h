// The view depths at which the numbers in which a technique tells depths apart are precise enough.
#pragma once

#include "scenes/depth_model.h"
#include "scenes/scene.h"

#include <string>

namespace shadowproof {

/// View depths from `nearest` to `furthest`; none where nearest > furthest.
struct SufficientDepths {
    double nearest = 0;
    double furthest = 0; ///< infinite: at any depth

    bool contains(double depth) const { return nearest <= depth && depth <= furthest; }
};

/// Where the error of depths (depth_error) displaces a shadow's border by one pixel at most, if
/// the side of the volume and the surface meet at 45 degrees there: if their depths part by a
/// pixel's width with each pixel. Along the middle of the picture.
SufficientDepths sufficient_depths(const Scene& scene, const DepthModel& depth_model);

/// "to 2399", "from 513 to 1.07e+05", "at any depth", "at no depth": for a camera with that near
/// plane, and depths times `unit`.
std::string words_of(const SufficientDepths& depths, double near, double unit);

} // namespace shadowproof
