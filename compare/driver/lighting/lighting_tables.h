// The tables of the techniques' lighting, made a second time from their definitions, so that the
// judge shares no code with the claim: it uses nothing of bump_forms.cpp, relief.cpp,
// plane_equations.cpp, polygon_tangents.cpp, texel_sides.cpp and make_normalisation_cube in
// scenes/surface/.
#pragma once

#include "scenes/scene.h"
#include "scenes/surface/bump_forms.h"
#include "scenes/surface/normalisation_cube.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// Central differences of a height field's red channel, in heights per texel times `scale`: along a
/// row, and down the rows. Past the border are the texels of the wrap mode; for mirrored, those of
/// the border itself.
Image<glm::dvec2> expected_slopes(const TextureImage& heights, double scale);

/// The normals at a bump map's texels, of any length: of heights, by these slopes, in texels.
Image<glm::dvec3> expected_normals(const Scene& scene, const TextureImage& map,
                                   const Material& material);

/// As bump_forms.h defines them. The form must be one that the material can have.
BumpTexels expected_bump_texels(const Scene& scene, const Material& material, BumpForm form);

/// The normal that a number stands for (indexed_normal's definition).
glm::dvec3 expected_normal(std::uint16_t number);

/// As texel_sides.h defines them; the triangle must have a bump map. Zero where it has no area in
/// the texture.
struct ExpectedTexelSides {
    glm::dvec3 along{0, 0, 0};
    glm::dvec3 down{0, 0, 0};
};
ExpectedTexelSides expected_texel_sides(const Scene& scene, std::uint32_t triangle);

/// As polygon_tangents.h defines them. The technique's tangents and these are rounded to floats,
/// and may fall to either side: polygon_tangent_error apart.
std::vector<Surface> expected_polygon_surfaces(const Scene& scene);

/// As normalisation_cube.h defines it.
NormalisationCube expected_normalisation_cube(int size);

} // namespace shadowproof
