// The texels of a bump map at all levels of a mipmap, as the ways of filtering (BumpFilter) read
// them. Made once from the asset's; the same numbers, as floats, go to OpenGL.
#pragma once

#include "scenes/image.h"
#include "scenes/lighting_settings.h"
#include "scenes/scene.h"

#include <glm/vec4.hpp>
#include <vector>

namespace shadowproof {

/// Each level is that of mipmap.h. n is the normal at a texel of level 0, normalised, in the
/// texture's axes, x along a row, y up the picture (of length zero: 0, 0, 1); of a height field
/// (-s, t, 1) over its length, with the slopes of relief.h. Heights in units of space are taken for
/// heights in texels, as bump_forms.h has it.
struct BumpPyramid {
    /// renormalised, toksvig: the mean of n, which is shorter than 1 where the bumps vary; alpha 1.
    /// dimmed: that mean's direction (of length zero: 0, 0, 1), and in alpha its length.
    /// lean: means of b.x, b.y, b.x b.x and b.y b.y, with b = n.xy / n.z.
    std::vector<Image<glm::vec4>> levels{};
    std::vector<Image<glm::vec4>> cross{}; ///< lean: the mean of b.x b.y, in red; else empty
};

/// Slopes are read of no normal that is steeper than this, n.z: what is less, or behind the
/// surface, is taken for it. A byte tells no smaller number from 0.
inline constexpr double least_cosine_of_slopes = 1.0 / 128;

/// Of a material that has a bump map; `filter` is not BumpFilter::none.
BumpPyramid bump_pyramid(const Scene& scene, const Material& material, BumpFilter filter);

/// All levels of a picture, each texel a mean.
std::vector<Image<glm::vec4>> mipmap_of(const Image<glm::vec4>& texels);

} // namespace shadowproof
