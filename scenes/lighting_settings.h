// Settings of the techniques that light bump maps: where the vectors are made and how they are
// normalised, which tangents they are carried by, in which form the bumps are stored, and how they
// are filtered.
#pragma once

#include "scenes/byte_blending.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace shadowproof {

/// How the vectors to light and eye and the half-angle vector are normalised.
enum class Normalisation : std::uint8_t {
    exact,          ///< divided by their length
    cube_map,       ///< looked up in a cube map (normalisation_cube.h)
    newton_raphson, ///< steps from an estimate made of the float's bits, one by default
};

/// Texels a side of a face of the normalisation cube map.
inline constexpr int usual_cube_size = 64;
inline constexpr int largest_cube_size = 1024;
/// Steps of Newton and Raphson. Three leave an error far below a float's rounding.
inline constexpr int usual_newton_steps = 1;
inline constexpr int most_newton_steps = 3;

/// What a bump map's texels hold.
enum class BumpForm : std::uint8_t {
    as_given,     ///< as the asset has it
    height_field, ///< heights, with slopes by finite differences; never made of a normal map
    normal_map,   ///< normals of 8 bits per component
    derivatives,  ///< pairs of slopes, 8 bits each
    indexed,      ///< 16-bit indices into a table of normals
};

/// What stands for the bumps where a pixel is as large as several texels.
enum class BumpFilter : std::uint8_t {
    none,         ///< those of level 0 around its centre, mixed bilinearly
    renormalised, ///< the mean normal of a mipmap, normalised
    dimmed,       ///< its direction; its length dims the diffuse term (Kilgard 2001)
    toksvig,      ///< its direction; its length widens and dims highlights (Toksvig 2005)
    lean, ///< mean slopes; how far slopes vary widens and dims highlights (Olano & Baker 2010)
};

/// Lookups along a pixel's longer side, at most; 1: as many texels are taken along both.
inline constexpr int usual_anisotropy = 1;
inline constexpr int largest_anisotropy = 16;

/// Where the vector to the light and the half-angle vector are made, of techniques that light in
/// tangent space.
enum class VectorOrigin : std::uint8_t {
    per_pixel,        ///< carried into tangent space by the frame that is interpolated there
    at_vertices,      ///< carried at the vertices, of any length, and interpolated
    unit_at_vertices, ///< the same, normalised at the vertices too
};

/// Whose tangents a technique uses.
enum class TangentSource : std::uint8_t {
    vertices, ///< the asset's own, or those that MikkTSpace's rule averages at a vertex
    polygons, ///< each triangle's, from its plane equations (polygon_tangents.h)
};

inline constexpr std::array all_vector_origins{VectorOrigin::per_pixel, VectorOrigin::at_vertices,
                                               VectorOrigin::unit_at_vertices};
inline constexpr std::array all_tangent_sources{TangentSource::vertices, TangentSource::polygons};
inline constexpr std::array all_normalisations{Normalisation::exact, Normalisation::cube_map,
                                               Normalisation::newton_raphson};
inline constexpr std::array all_bump_forms{BumpForm::as_given, BumpForm::height_field,
                                           BumpForm::normal_map, BumpForm::derivatives,
                                           BumpForm::indexed};

constexpr std::string_view name_of(BumpFilter filter) {
    switch (filter) {
    case BumpFilter::none:
        return "none";
    case BumpFilter::renormalised:
        return "renormalised";
    case BumpFilter::dimmed:
        return "dimmed";
    case BumpFilter::toksvig:
        return "toksvig";
    case BumpFilter::lean:
        return "lean";
    }
    return "";
}

constexpr std::string_view name_of(Normalisation normalisation) {
    switch (normalisation) {
    case Normalisation::exact:
        return "exact";
    case Normalisation::cube_map:
        return "cube-map";
    case Normalisation::newton_raphson:
        return "newton-raphson";
    }
    return "";
}

constexpr std::string_view name_of(VectorOrigin origin) {
    switch (origin) {
    case VectorOrigin::per_pixel:
        return "per-pixel";
    case VectorOrigin::at_vertices:
        return "at-vertices";
    case VectorOrigin::unit_at_vertices:
        return "unit-at-vertices";
    }
    return "";
}

constexpr std::string_view name_of(TangentSource source) {
    switch (source) {
    case TangentSource::vertices:
        return "vertices";
    case TangentSource::polygons:
        return "polygons";
    }
    return "";
}

constexpr std::string_view name_of(BumpForm form) {
    switch (form) {
    case BumpForm::as_given:
        return "as-given";
    case BumpForm::height_field:
        return "height-field";
    case BumpForm::normal_map:
        return "normal-map";
    case BumpForm::derivatives:
        return "derivatives";
    case BumpForm::indexed:
        return "indexed";
    }
    return "";
}

/// What the user asked for; where nothing is set, each technique uses its own.
struct LightingSettings {
    std::optional<Normalisation> normalisation{};
    std::optional<int> cube_size{};    ///< 2 to largest_cube_size
    std::optional<int> newton_steps{}; ///< 0 to most_newton_steps
    std::optional<BumpForm> bump_form{};
    std::optional<VectorOrigin> vectors{};
    std::optional<TangentSource> tangents{};
    std::optional<int> anisotropy{}; ///< 1 to largest_anisotropy; of techniques that filter
};

/// How a technique computes its colours, from which they are predicted.
struct ColorModel {
    enum class Arithmetic : std::uint8_t {
        floating,     ///< 32-bit floats from beginning to end
        three_passes, ///< floats within a pass, 8 bits per channel between passes
        two_stages,   ///< three passes of register combiners with two general stages: 8 bits and a
                      ///< sign after each stage, 8 bits per channel between passes
        four_stages,  ///< one pass of register combiners with four general stages
    };
    /// The axes in which normals, tangents and the vectors to light and eye are given and
    /// normalised.
    enum class Axes : std::uint8_t { world, eye };
    Arithmetic arithmetic = Arithmetic::floating;
    Axes axes = Axes::world;
    Normalisation normalisation = Normalisation::exact;
    BumpForm bump_form = BumpForm::as_given;
    VectorOrigin vectors = VectorOrigin::per_pixel; ///< another only where `axes` is world
    TangentSource tangents = TangentSource::vertices;
    bool reflects = false;                 ///< the scene's environment
    BumpFilter filter = BumpFilter::none;  ///< another only where axes are the world's
    int anisotropy = usual_anisotropy;     ///< where it filters
    int cube_size = usual_cube_size;       ///< of Normalisation::cube_map
    int newton_steps = usual_newton_steps; ///< of Normalisation::newton_raphson
    ByteErrors bytes = llvmpipe_bytes;     ///< taken from the driver
};

/// Whether its vectors to light and eye are made as the truth's are, pixel by pixel. Others are off
/// by nature, as far as a triangle is bent.
constexpr bool makes_vectors_as_truth(const ColorModel& model) {
    return model.vectors == VectorOrigin::per_pixel && model.tangents == TangentSource::vertices;
}

/// Whether its colours stand for all of a pixel, of which the truth is the mean. Others stand for
/// the pixel's centre.
constexpr bool filters(const ColorModel& model) {
    return model.filter != BumpFilter::none;
}

/// A technique's own model, except for what the user asked for.
constexpr ColorModel with_settings(ColorModel model, const LightingSettings& settings) {
    model.normalisation = settings.normalisation.value_or(model.normalisation);
    model.cube_size = settings.cube_size.value_or(model.cube_size);
    model.newton_steps = settings.newton_steps.value_or(model.newton_steps);
    model.bump_form = settings.bump_form.value_or(model.bump_form);
    model.tangents = settings.tangents.value_or(model.tangents);
    if (filters(model)) model.anisotropy = settings.anisotropy.value_or(model.anisotropy);
    if (model.axes == ColorModel::Axes::world)
        model.vectors = settings.vectors.value_or(model.vectors);
    return model;
}

} // namespace shadowproof
