// The door of raster/: a technique's picture of a scene, checked to be a picture at all.
#pragma once

#include "raster/context.h"
#include "raster/technique.h"

namespace shadowproof {

/// Throws Error where the technique is not for such a scene (suits), where the driver fails, and
/// where the frame read back is blank (no surface at all although geometry was drawn is left to the
/// caller's truth), holds NaN depth, or comes from a driver whose pixels are not those of
/// llvmpipe's 8 subpixel bits.
Frame render(const Technique& technique, const Scene& scene, const Plan& plan, Gpu& gpu);

} // namespace shadowproof
