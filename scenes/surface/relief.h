// Height fields: the slopes of a surface whose height is known texel by texel, and its normals.
#pragma once

#include "scenes/texture.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace shadowproof {

/// Slopes along a row (to the right) and down the rows, in heights per texel, at each texel's
/// centre. Central differences: half the difference between the next texel and the one before;
/// beyond the border the wrap modes say which texel is the neighbour. `scale` is the height that
/// the value 1 stands for, in texels.
Image<glm::dvec2> slopes_of(const Image<double>& heights, Wrap wrap_s, Wrap wrap_t, double scale);

/// The same for a texture's red channel.
Image<glm::dvec2> slopes_of(const TextureImage& heights, double scale);

/// glTF's normal map of a height field at a mipmap level: rgb is 0.5 + 0.5 n, x to the right, y up
/// the picture; alpha is the denormalisation factor.
///
/// At level 0 n is (-s, t, 1) over its length, s and t the slopes, and alpha is 1. A texel of a
/// higher level (mipmap.h) has as n the direction of the mean of all that it covers, and as alpha
/// that mean's length: 1 where the surface is flat, less where it is rough (Kilgard 2001:
/// dimFactor). A mean of length zero has the direction 0, 0, 1. Nothing is rounded to bits here.
Image<glm::dvec4> normal_map_of(const Image<glm::dvec2>& slopes, int level = 0);

} // namespace shadowproof
