// How near a surface is, as window depths tell it: the larger, the nearer. In perspective that is
// the inverse view depth; where lines of sight are parallel, minus the view depth. Either is linear
// over the picture.
#pragma once

#include "scenes/depth_model.h"
#include "scenes/frame.h"
#include "scenes/image.h"

namespace shadowproof {

/// Error of any nearness by the window's roundings: see driver/error_bounds.h.
struct WindowRoundings {
    double constant = 0;
    double share = 0; ///< of its size
};
WindowRoundings window_roundings(const DepthModel& model);

/// Of a window depth.
double nearness_of_window(const DepthModel& model, double window_depth);
/// Of a view depth.
double nearness_of_depth(const DepthModel& model, double depth);

/// That to which clamping brings what lies past the far plane, nearer than its own; minus infinity
/// where nothing is clamped there.
double furthest_nearness(const DepthModel& model);

/// That of what was read back, pixel by pixel: a face is behind it where its own is less. A
/// background is behind everything.
Image<double> nearness_read_back(const Frame& frame);

} // namespace shadowproof
