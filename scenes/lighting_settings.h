// The settings of the techniques that light bump maps: how vectors are made of unit length, and in
// which form the bumps are kept.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace shadowproof {

/// How the vectors to light and eye and the half-angle vector are made of unit length.
enum class Normalisation : std::uint8_t {
    exact,          ///< over their length
    cube_map,       ///< looked up in a cube map (normalisation_cube.h)
    newton_raphson, ///< one step from a guess by the float's bits
};

/// What stands in a bump map's texels.
enum class BumpForm : std::uint8_t {
    as_given,     ///< as the asset has it
    height_field, ///< heights, their slopes found by finite differences; not of a normal map
    normal_map,   ///< normals of 8 bits a component
    derivatives,  ///< pairs of slopes, 8 bits each
    indexed,      ///< numbers of 16 bits in a table of normals
};

inline constexpr std::array all_normalisations{Normalisation::exact, Normalisation::cube_map,
                                               Normalisation::newton_raphson};
inline constexpr std::array all_bump_forms{BumpForm::as_given, BumpForm::height_field,
                                           BumpForm::normal_map, BumpForm::derivatives,
                                           BumpForm::indexed};

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

/// What was asked for; where nothing was, each technique has its own.
struct LightingSettings {
    std::optional<Normalisation> normalisation{};
    std::optional<BumpForm> bump_form{};
};

/// How a technique makes its colours: all that is needed to foresee them.
struct ColorModel {
    enum class Arithmetic : std::uint8_t {
        floating,     ///< 32-bit floats from beginning to end
        three_passes, ///< floats within a pass, 8 bits a channel between them
        combiners,    ///< one pass of register combiners: 8 bits and a sign after each stage
    };
    /// In which normals, tangents and the vectors to light and eye are handed over, and in which
    /// those are made of unit length.
    enum class Axes : std::uint8_t { world, eye };
    Arithmetic arithmetic = Arithmetic::floating;
    Axes axes = Axes::world;
    Normalisation normalisation = Normalisation::exact;
    BumpForm bump_form = BumpForm::as_given;
    bool reflects = false; ///< the scene's environment
};

/// A technique's own way, but for what was asked for.
constexpr ColorModel with_settings(ColorModel model, const LightingSettings& settings) {
    model.normalisation = settings.normalisation.value_or(model.normalisation);
    model.bump_form = settings.bump_form.value_or(model.bump_form);
    return model;
}

} // namespace shadowproof
