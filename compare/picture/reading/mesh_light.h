// What light and shadow look like on one mesh of a picture.
#pragma once

#include "compare/picture/reading/shading_normals.h"
#include "scenes/frame.h"

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

/// Of a file's integers. A difference of two colours is off by one of them at most, and is asked
/// whether it is more than half of what light adds: with four, that may be off by a quarter.
inline constexpr double fewest_steps = 4;

/// What so many show is no outline's.
inline constexpr std::size_t enough_pixels = 16;

/// How one of all_normals_by lies to light and eye.
struct Lie {
    float sine = 0; ///< of the angle at which the light falls: below 0 where it falls on the other
                    ///< side than on the triangle itself
    float off_half = 0; ///< sine of the angle to the vector half way between light and eye, by
                        ///< which highlights get weaker
};
using Lies = std::array<Lie, all_normals_by.size()>;

/// A pixel that sees the mesh.
struct Observed {
    /// The picture's colour. Of a pair, how it differs from the twin's, over the twin's brightness
    /// where that is more than a few steps: so surfaces of all colours are alike.
    glm::dvec3 value{0, 0, 0};
    float step = 0; ///< what a step of the file's integers changes `value` by, or what noise takes
    Lies lies{};
    float distance = 1; ///< from the light; 1 where it is directional
    /// How far a spot's light has come from its outer cone (0) to its inner one (1), evenly by the
    /// cosine of the angle to its axis; 0 outside, 1 of other lights.
    float into_cone = 1;
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
    double typical = 0;
    double least = 0; ///< what all lit pixels have: bumps, and normals that nobody knows, make some
                      ///< darker than others
};
/// By growing sines, at distance 1.
using LightByAngle = std::vector<LightAt>;

/// Groups of pixels that are about as far from a highlight's middle, by Lie::off_half, in equal
/// parts.
inline constexpr int highlight_groups = 16;
std::size_t highlight_group(const Lie& lie);

/// A colour's, or that of a difference of colours.
double brightness(const glm::dvec3& color);

/// Where between shadow (0) and light (1) a pixel lies.
struct ShownLight {
    double share = 0;
    /// False where light adds too little, or the pixel is brighter than half the least light, and
    /// darker than half the typical; and of dark ones between a spot's cones, where the fall-off is
    /// not known.
    bool told = false;
};

/// Whether a spot's light is there, but perhaps not all of it.
inline bool is_between_cones(const Observed& pixel) {
    return pixel.into_cone > 0 && pixel.into_cone < 1;
}

/// Equal parts of the way from a spot's outer cone to its inner one.
inline constexpr std::size_t cone_parts = 16;
/// That of a pixel; cone_parts within the inner cone.
inline std::size_t cone_part(const Observed& pixel) {
    return static_cast<std::size_t>(cone_parts * pixel.into_cone);
}

/// Which share of a spot's light is there, so far into its cone; the largest is 1.
struct ConeShare {
    double into_cone = 0;
    double share = 0;
};

struct MeshLight {
    std::optional<Typical> shadow; ///< nothing where the pixels do not tell it
    std::size_t normals = 0;       ///< by which of all_normals_by the surface is lit
    LightByAngle light;            ///< of all pixels
    std::array<LightByAngle, highlight_groups> in_highlight; ///< where enough pixels tell it
    double fall_off = 0;         ///< with which power of the distance light gets weaker
    std::vector<ConeShare> cone; ///< by growing Observed::into_cone; empty: all is there at once
    /// Where the pixels do not tell how bright a part of the way between a spot's cones is.
    std::array<bool, cone_parts> is_cone_unknown{};

    /// How much lighter than shadow: a distance of colours, negative where it is darker.
    double above_shadow(const glm::dvec3& value) const;
    /// What tells light from shadow, at least: four steps of the file's integers, and four times
    /// what shadows scatter.
    double least_difference(double step) const;
    /// Which share of a spot's light is there: between those that are known it grows evenly, and
    /// from nothing at the outer cone. Outside, false light would be all there. `least`: no less
    /// than that, however it grows.
    double share_in_cone(const Observed& pixel) const;
    double least_in_cone(const Observed& pixel) const;
    /// Which share of its light at distance 1, and where all of a spot's is there, arrives.
    double share_at(const Observed& pixel) const;
    /// What light adds at a pixel: between angles that are known it grows evenly, and from nothing
    /// where it only grazes. Nothing where no angle is known.
    LightAt light_at(const Observed& pixel) const;
    ShownLight shown_light(const Observed& pixel) const;
};

/// By the best of several fits; not told where it says that the pixel is dark, and another one does
/// not.
ShownLight shown_light(std::span<const MeshLight> fits, const Observed& pixel);

} // namespace shadowproof
