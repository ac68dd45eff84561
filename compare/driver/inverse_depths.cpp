#include "compare/driver/inverse_depths.h"

#include "compare/driver/plane_at_pixel.h"
#include "scenes/driver.h"

#include <cmath>
#include <limits>

namespace shadowproof {

namespace {

/// Change of window depth with inverse view depth, taken between infinity and the near plane: over
/// far smaller steps it would be lost to rounding.
double slope_of_window_depth(const DepthModel& model) {
    const WindowDepth depth = window_depth_of(model);
    return (depth.at(1 / model.near) - depth.at(0)) * model.near;
}

} // namespace

WindowRoundings window_roundings(const DepthModel& model) {
    const double error = window_depth_roundings * float_roundoff;
    if (model.reversed()) return {0, error};
    return {error / std::abs(slope_of_window_depth(model)), 0};
}

double inverse_depth(const DepthModel& model, double window_depth) {
    return (window_depth - window_depth_of(model).at(0)) / slope_of_window_depth(model);
}

Image<double> inverse_depths(const Frame& frame) {
    Image<double> inverse(frame.depth.width, frame.depth.height);
    for (std::size_t i = 0; i < inverse.pixels.size(); ++i)
        inverse.pixels[i] = frame.triangle.pixels[i] == no_triangle
                                ? -std::numeric_limits<double>::infinity()
                                : inverse_depth(frame.depth_model, frame.depth.pixels[i]);
    return inverse;
}

} // namespace shadowproof
