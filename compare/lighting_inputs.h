// What lighting is given at a pixel: as the truth has it, and as a technique has it by its way of
// making vectors of unit length, by the form of its bump map and by the roundings of its floats.
#pragma once

#include "compare/interval.h"
#include "compare/setup_freedom.h"
#include "reference/shading.h"
#include "scenes/bump_forms.h"
#include "scenes/lighting_settings.h"
#include "scenes/normalisation_cube.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace shadowproof {

/// Vectors are in the tangent space of the side that is seen: along T, B and N, which is z.
struct LightingInputs {
    Intervals light;      ///< L
    Intervals half;       ///< H
    Intervals bump;       ///< N'
    Intervals radiance;   ///< what arrives from the light, without visibility
    Intervals decal;      ///< linear
    Interval gloss;       ///< 1 where the decal's alpha is none
    Intervals reflection; ///< of the environment; 0 unless the model reflects it
    glm::dvec3 specular;  ///< colour
    glm::dvec3 ambient;
    bool lit = false;
};

/// Of one scene and one way of making colours, made once. A model that leaves reflections out is
/// not for a scene with an environment (suits in raster/technique.h).
struct LightingTables {
    const Scene* scene = nullptr;
    ColorModel model;
    std::vector<std::optional<BumpTexels>> bumps; ///< a material; none where it has no bump map
                                                  ///< or is not drawn
    std::vector<Image<glm::dvec2>> slopes;        ///< a material; where those are heights
    NormalisationCube cube;                       ///< where the model asks for one
};
LightingTables make_lighting_tables(const Scene& scene, const ColorModel& model);

/// A point that is shaded, and where else its texture coordinates may lie by rounding.
struct InputPoint {
    const Shading& shading; ///< with all terms
    std::uint32_t triangle = 0;
    glm::dvec2 bump_off{0, 0};  ///< added to the coordinates of the bump map
    glm::dvec2 decal_off{0, 0}; ///< and of the decal
};

/// By the definition in shading.h, without roundings.
LightingInputs true_inputs(const LightingTables& tables, const InputPoint& point);

/// As the technique has them. `share`: attribute_freedom at the pixel.
LightingInputs claimed_inputs(const LightingTables& tables, const InputPoint& point, double share);

/// By how much texture coordinates may be off by the same share: of the bump map, of the decal.
struct CoordinateFreedom {
    glm::dvec2 bump{0, 0};
    glm::dvec2 decal{0, 0};
};
CoordinateFreedom coordinate_freedom(const Scene& scene, std::uint32_t triangle, double share);

} // namespace shadowproof
