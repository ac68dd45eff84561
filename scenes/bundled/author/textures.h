// Textures of the bump-mapped stages, painted by formulas.
#pragma once

#include "scenes/bundled/author/png.h"

#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace shadowproof::author {

/// Height at a texture coordinate, 0 to 1.
using Relief = std::function<double(double u, double v)>;

/// Round bumps on a lattice, `columns` by `rows` of them; repeats.
Relief bumps(unsigned columns, unsigned rows);

/// A slanted hook and three dots: unlike any mirror image of itself.
Relief hook();

/// Ripples around the centre, and a step across them.
Relief ripples();

/// Squares of random heights, `columns` each way; repeats.
Relief gravel(unsigned columns);

/// Rows of random heights, `rows` of them, as if brushed along the rows; repeats.
Relief grooves(unsigned rows);

/// Gray of 16 bits.
Raster height_map(unsigned width, unsigned height, const Relief& relief);

/// glTF's normal map of a relief `scale` texels high, by central differences that wrap around; 8
/// bits.
Raster normal_map(unsigned width, unsigned height, const Relief& relief, double scale);

/// RGBA of 8 bits: stripes of two colours (sRGB) across the relief, with gloss where it is high.
Raster glossy_stripes(unsigned width, unsigned height, const Relief& relief,
                      const glm::dvec3& color, const glm::dvec3& other);

/// RGBA of 8 bits: one colour (sRGB), and the relief as its alpha.
Raster masked_color(unsigned width, unsigned height, const Relief& relief, const glm::dvec3& color);

/// One of six faces (+x -x +y -y +z -z) around a photographer's stage, RGB of 8 bits: sky over a
/// plain, and bright windows with panes, above the horizon.
Raster surroundings(unsigned face, unsigned size);

} // namespace shadowproof::author
