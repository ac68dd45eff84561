// Inverse view depths as window depths give them, and their roundings.
#pragma once

#include "scenes/depth_model.h"
#include "scenes/frame.h"
#include "scenes/image.h"

namespace shadowproof {

/// Error of any inverse depth by the window's roundings: see driver/error_bounds.h.
struct WindowRoundings {
    double constant = 0;
    double share = 0; ///< of its size
};
WindowRoundings window_roundings(const DepthModel& model);

/// Of a window depth.
double inverse_depth(const DepthModel& model, double window_depth);

/// The inverse view depths of what was read back, pixel by pixel: a face is behind it where its own
/// is less. A background is behind everything.
Image<double> inverse_depths(const Frame& frame);

} // namespace shadowproof
