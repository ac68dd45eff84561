// The tables that techniques light by, made once more from their definitions: what the judge holds
// against a claim must not come out of the function that made the claim. Nothing of
// scenes/bump_forms.cpp, scenes/relief.cpp or make_normalisation_cube is asked here.
#pragma once

#include "scenes/bump_forms.h"
#include "scenes/normalisation_cube.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// Central differences of a height field's red, in heights per texel times `scale`: along a row,
/// and down the rows. Beside the border lies what the wrap mode has there; mirrored: the border.
Image<glm::dvec2> expected_slopes(const TextureImage& heights, double scale);

/// As bump_forms.h defines them. The form must be one that the material can have.
BumpTexels expected_bump_texels(const Scene& scene, const Material& material, BumpForm form);

/// The normal that a number stands for (indexed_normal's definition).
glm::dvec3 expected_normal(std::uint16_t number);

/// As normalisation_cube.h defines it.
NormalisationCube expected_normalisation_cube(int size = 64);

} // namespace shadowproof
