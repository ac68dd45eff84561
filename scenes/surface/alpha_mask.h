// How an alpha mask is read: by the wrapping and the interpolation of scenes/texture.h.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

namespace shadowproof {

/// The texel of a row of `texels` that is read for number `texel` of the endless row which the wrap
/// mode makes of it.
int wrapped(Wrap wrap, int texels, std::int64_t texel);

struct AlphaRange {
    double low = 0;
    double high = 1;
};

/// Bounds of a mask's alpha over the rectangle of texture coordinates from `low` to `high`: its
/// least and its most there, to within a few roundings of doubles. All that alpha may be where the
/// rectangle is no number or spans many texels.
AlphaRange alpha_range(const AlphaMask& mask, const glm::dvec2& low, const glm::dvec2& high);

/// The scene with nothing left out.
Scene without_masks(Scene scene);

/// A triangle's texture coordinates, by corner. The scene must have masks.
std::array<glm::dvec2, 3> mask_coordinates(const Scene& scene, std::uint32_t triangle);

} // namespace shadowproof
