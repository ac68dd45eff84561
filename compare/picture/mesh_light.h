// What light and shadow look like on one mesh of a picture, fitted to its pixels.
#pragma once

#include "scenes/frame.h"

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

/// A pixel that sees the mesh.
struct Observed {
    /// The picture's colour. Of a pair, how it differs from the twin's, over the twin's brightness
    /// where that is more than a few steps: so surfaces of all colours are alike.
    glm::dvec3 value{0, 0, 0};
    float step = 0;           ///< what a step of the file's integers changes `value` by
    float sine = 0;           ///< of the angle at which the light falls
    float distance = 1;       ///< from the light; 1 where it is directional
    bool is_ratio = false;    ///< `value` is a difference over the twin's brightness
    bool faces_light = false; ///< others are dark in any case
    /// Truly, and so are all pixels around, so that no outline of another renderer has it
    /// otherwise.
    std::optional<Visibility> certainly{};
};

/// Of many colours the median, channel by channel, and the median distance from it.
struct Typical {
    glm::dvec3 color{0, 0, 0};
    double scatter = 0;
};

/// What light adds to shadow, at the sine of one angle.
struct LightAt {
    double sine = 0;
    double added = 0;
};

struct MeshLight {
    std::optional<Typical> shadow; ///< nothing where the pixels do not tell it
    std::vector<LightAt> light;    ///< by growing sines, at distance 1
    double fall_off = 0;           ///< with which power of the distance light gets weaker

    /// How much lighter than shadow: a distance of colours, negative where it is darker.
    double above_shadow(const glm::dvec3& value) const;
    /// What tells light from shadow, at least: four steps of the file's integers, and four times
    /// what shadows scatter.
    double least_difference(double step) const;
    /// What light adds at a pixel: between angles that are known it grows evenly, and from nothing
    /// where it only grazes. Nothing where that is not known, or too little to be told.
    std::optional<double> light_at(const Observed& pixel) const;
};

/// `are_differences`: from a picture without light, so that shadow is none. Else shadow is
///   - the typical colour of surfaces that face away from the light;
///   - where none are seen, that of pixels that are certainly in shadow, if the picture shows them
///     darker than lit ones at the same angle;
///   - else the darker of two groups into which pixels at one angle fall.
/// Light is the typical colour of what is brighter, angle by angle, and as it falls off with
/// distance.
MeshLight fitted_light(std::span<const Observed* const> pixels, bool are_differences);

} // namespace shadowproof
