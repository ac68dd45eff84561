// Noise of pictures: how much light must add at a pixel so that noise is not taken for light or
// shadow anywhere. It is measured as what neighbours on one mesh differ by, where all that is known
// of them is taken away: light from all around is smooth. Noise is taken to be normal, independent
// from pixel to pixel, and alike in light and shadow.
#pragma once

#include "compare/picture/reading/observed_colors.h"
#include "compare/picture/reading/seen_pixels.h"

namespace shadowproof {

/// Of a picture with both twins: how far apart these must be at a pixel. Measured along the light,
/// from the twin that the picture is nearer to, where light adds much.
double least_beyond_noise(const Picture& picture, const Twins& twins, const SeenPixels& pixels);

/// Of two pictures: how much they must differ by. Measured where they should be alike: on surfaces
/// that face away from the light or, where those are too few, on pixels that are certainly `alike`
/// in truth, if most of them are in the pictures, too.
double least_beyond_noise(const Picture& picture, const Picture& twin, Visibility alike,
                          const SeenPixels& pixels);

} // namespace shadowproof
