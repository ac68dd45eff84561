// The inputs of lighting at a pixel, as ranges: those of the truth, and those of a technique, which
// depend on how it normalises vectors, on the form of its bump map and on its float roundings.
#pragma once

#include "compare/driver/interpolated.h"
#include "compare/driver/lighting/filtered_tables.h"
#include "compare/driver/lighting/texel_ranges.h"
#include "compare/driver/lighting/vector_range.h"
#include "reference/shade/shading.h"
#include "scenes/lighting_settings.h"
#include "scenes/scene.h"
#include "scenes/surface/bump_forms.h"
#include "scenes/surface/normalisation_cube.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

/// What a filter leaves of the bumps under a pixel (BumpFilter), in tangent space.
struct FilteredBumps {
    BumpFilter filter = BumpFilter::none;
    VectorRange normal{};             ///< of length 1
    Interval length{1, 1};            ///< of the mean normal, where the filter tells
    std::array<Interval, 2> slope{};  ///< mean slopes; lean alone
    std::array<Interval, 3> spread{}; ///< their variances and their covariance; lean alone
};

/// Vectors are in the tangent space of the seen side: T, B and N are its x, y and z axes.
struct LightingInputs {
    VectorRange light;                       ///< L
    VectorRange half;                        ///< H
    VectorRange bump;                        ///< N'
    std::optional<FilteredBumps> filtered{}; ///< of bumps, where the technique filters
    Intervals radiance;                      ///< incident light, without visibility
    Intervals decal;                         ///< linear
    Interval gloss;                          ///< 1 where the decal's alpha is not a gloss
    Intervals reflection;                    ///< of the environment; 0 unless the model reflects it
    glm::dvec3 specular;                     ///< colour
    glm::dvec3 ambient;
    Highlight highlight; ///< as the scene has it
    bool lit = false;
};
/// Those of one pixel under each light that is added up, the chosen one last. Only vectors to the
/// light, radiance, and whether it is seen, differ.
using AddedInputs = std::span<const LightingInputs>;

/// The tables of one scene and one colour model, made once. A model without reflections is not for
/// a scene with an environment (suits in raster/technique.h).
struct LightingTables {
    const Scene* scene = nullptr;
    ColorModel model;
    /// One per material; none where it has no bump map or is not drawn, or the model filters.
    std::vector<std::optional<BumpTexels>> bumps;
    std::vector<Image<glm::dvec2>> slopes; ///< one per material; where the asset has heights
    NormalisationCube cube;                ///< where the model uses one
    /// Where the model filters: one per material, likewise; and by index into Scene::textures, of
    /// decals.
    std::vector<std::optional<ExpectedPyramid>> pyramids;
    std::vector<ExpectedMipmap> decals;
    /// As Scene::surfaces, with tangents of polygons; empty where the model has those of vertices.
    std::vector<Surface> polygon_surfaces;
};
LightingTables make_lighting_tables(const Scene& scene, const ColorModel& model);

/// The slopes of a material's heights, as the asset has them, over a range of places.
RangeOf<glm::dvec2> slope_range(const LightingTables& tables, const Material& material,
                                const PlaceRange& at);

/// A point that is shaded under a light, and what is interpolated there.
struct InputPoint {
    const Scene& scene;     ///< with that light chosen; else as the tables'
    const Shading& shading; ///< with all terms
    std::uint32_t triangle = 0;
    PixelSpread spread;
    Interpolated interpolated; ///< from the surfaces that the scene has
};
InputPoint input_point(const Scene& scene, const Shading& shading, std::uint32_t triangle,
                       const PixelSpread& spread);

/// The inputs by the definition in shading.h, at the pixel's centre, without roundings.
LightingInputs true_inputs(const LightingTables& tables, const InputPoint& point);

/// Which of a pixel's possible extents over its bump map and its decal (footprint_ranges) a
/// technique that filters takes: all inputs are of one, so that they are not mixed with another's.
struct FootprintChoice {
    std::size_t bump = 0;
    std::size_t decal = 0;
};
/// All of them; one alone of a technique that does not filter.
std::vector<FootprintChoice> footprint_choices(const LightingTables& tables,
                                               const InputPoint& point);

/// The technique's inputs: its own arithmetic replayed, with tables made from their definitions
/// (lighting_tables.h).
LightingInputs claimed_inputs(const LightingTables& tables, const InputPoint& point,
                              const FootprintChoice& choice = {});

/// The truth's vectors with one of the technique's ways of making them and no other, at the pixel's
/// centre; what does not depend on it is the technique's.
struct SingleStepInputs {
    LightingInputs normalised;  ///< its way of normalising
    LightingInputs at_vertices; ///< made at vertices, where it does that
    LightingInputs of_polygons; ///< carried by polygons' tangents, where it uses them
};
SingleStepInputs single_step_inputs(const LightingTables& tables, const InputPoint& centre);

} // namespace shadowproof
