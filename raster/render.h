// The entry to raster/: draws a scene with a technique, and checks that the result is a valid
// picture.
#pragma once

#include "raster/gl/context.h"
#include "raster/technique.h"

namespace shadowproof {

/// Draws or traces the scene as render does, without its checks.
Frame draw_with(Gpu& gpu, const Technique& technique, const Scene& scene, const Plan& plan);

/// Throws Error where the technique is not for such a scene (suits), where the driver fails, and
/// where the frame read back is blank (the caller's truth decides where no surface at all was
/// drawn), holds NaN depth, or comes from a driver whose pixels are not those of llvmpipe's 8
/// subpixel bits.
Frame render(const Technique& technique, const Scene& scene, const Plan& plan, Gpu& gpu);

} // namespace shadowproof
