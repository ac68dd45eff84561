// What colour is right where a pixel stands for all of what it covers, and not for its centre: the
// mean of the colours of shading.h over the pixel, each by the exact visibility of its own ray.
// What filtering of bump maps is judged by. For scenes that are bump-lit (is_bump_lit).
#pragma once

#include "reference/trace/lights_before.h"
#include "reference/trace/trace.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// A pixel's rays run through the middles of equal rectangles: 4 columns of them where neighbours
/// in the row are no more than a texel apart in the maps that are seen, and twice as many for each
/// time that they are twice as far apart, up to 32; rows likewise. So there are four rays along a
/// texel or, where a pixel covers more than eight, fewer.
struct PixelMeans {
    Image<glm::dvec3> color;  ///< linear; background counts as black
    Image<glm::dvec3> alike;  ///< mean of the rays that are alike; 0 at background
    Image<float> share_alike; ///< of the rays, that meet the mesh that the centre's ray meets, lit
                              ///< or shadowed as there, under each light
    Image<float> texels;      ///< of the bump map along the pixel's longer side at its centre; 0
                              ///< where that sees none
    Image<float> cosine;      ///< between the centre's ray and the normal of its triangle; 0 at
                              ///< background
    Image<glm::u8vec2> rays;  ///< columns and rows
    /// How far such means may be off themselves: root mean square, over the channels of pixels that
    /// see a surface at their centre, of half the difference that it makes to take of every four
    /// columns, and of every four rows, the inner two alone, or the outer; in steps of 1/255.
    double noise = 0;
};

/// `truth`: the tracer's. `before`: the lights whose light is added. Same bits for any number of
/// threads and any instruction set.
PixelMeans shade_pixels(const Tracer& tracer, const GroundTruth& truth,
                        const TracedLights& before = {});

/// The same of one pixel; all others are 0.
PixelMeans shade_pixel(const Tracer& tracer, const GroundTruth& truth, int x, int y,
                       const TracedLights& before = {});

} // namespace shadowproof
