#include "compare/driver/nearness.h"

#include "compare/driver/plane_at_pixel.h"
#include "scenes/driver.h"

#include <cmath>
#include <limits>

namespace shadowproof {

namespace {

/// Change of window depth with nearness; in perspective taken between infinity and the near plane:
/// over far smaller steps it would be lost to rounding.
double slope_of_window_depth(const DepthModel& model) {
    const WindowDepth depth = window_depth_of(model);
    if (model.parallel) return -depth.slope;
    return (depth.at(1 / model.near) - depth.at(0)) * model.near;
}

} // namespace

WindowRoundings window_roundings(const DepthModel& model) {
    const double error = window_depth_roundings * float_roundoff;
    if (model.reversed() && !model.parallel) return {0, error};
    return {error / std::abs(slope_of_window_depth(model)), 0};
}

double nearness_of_window(const DepthModel& model, double window_depth) {
    return (window_depth - window_depth_of(model).at(0)) / slope_of_window_depth(model);
}

double nearness_of_depth(const DepthModel& model, double depth) {
    return model.parallel ? -depth : 1 / depth;
}

double furthest_nearness(const DepthModel& model) {
    if (!model.clamp || !model.finite()) return -std::numeric_limits<double>::infinity();
    return nearness_of_window(model, model.reversed() ? model.front : 1);
}

Image<double> nearness_read_back(const Frame& frame) {
    Image<double> nearness(frame.depth.width, frame.depth.height);
    for (std::size_t i = 0; i < nearness.pixels.size(); ++i)
        nearness.pixels[i] = frame.triangle.pixels[i] == no_triangle
                                 ? -std::numeric_limits<double>::infinity()
                                 : nearness_of_window(frame.depth_model, frame.depth.pixels[i]);
    return nearness;
}

} // namespace shadowproof
