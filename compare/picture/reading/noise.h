// Noise of pictures: how much light must add at a pixel, that noise passes for light or shadow at
// no pixel. It is measured as what neighbours on one mesh differ by, where all that is known of
// them is taken away: light from all around is smooth.
#pragma once

#include "compare/picture/reading/observed_colors.h"
#include "compare/picture/reading/seen_pixels.h"

namespace shadowproof {

/// Of a picture with both twins: how far apart these must be at a pixel. Measured along the light,
/// from the twin that the picture is nearer to, where light adds much.
double least_beyond_noise(const Picture& picture, const Twins& twins, const SeenPixels& pixels);

/// Of differences of two pictures, measured on surfaces that face away from the light. Where it is
/// more than a file's steps, each pixel's step becomes so large that fewest_steps are beyond it.
void widen_steps_by_noise(SeenPixels& pixels);

} // namespace shadowproof
