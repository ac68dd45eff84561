// Why an answer of a shadow map is wrong, found by counterfactuals.
#pragma once

#include "compare/judge/judge.h"
#include "compare/maps/lookup.h"

#include <span>
#include <vector>

namespace shadowproof {

/// A wrong answer: the point whose light was looked up in the map, and what was found there.
struct WrongAnswer {
    std::uint32_t receiver = no_triangle; ///< the triangle that the point lies on
    glm::dvec3 from_light{0, 0, 0};       ///< the point, relative to the light
    Lookup lookup;                        ///< where it is looked up, exactly
    LightView::Shown shown;               ///< by the texel that was read
    bool claims_light = false;            ///< falsely lit, else falsely shadowed
};

/// The cause of each wrong answer: the first of these changes that makes the answer right. Many
/// answers are quicker together than one by one, as their rays are.
///
/// Where a block of texels is averaged:
///   seam        beyond its cube's face, the block continues on the adjacent one
///   filter      only the texel at the point's own place is asked. Where that texel's answer is
///               wrong as well, the changes below are applied to it
///
/// Falsely shadowed:
///   range       the map reaches the point; perhaps this needs one of the last two, too
///   precision   the texel holds its exact value, and nothing is rounded in the comparison
///   acne        the ray goes through the point itself, instead of the texel's centre; no caster
///               lies on that ray. The texel shows the receiver, or a triangle that shares a corner
///               with it, so that a larger bias mends it, too
///   resolution  the same, and the texel shows another triangle. With a bias below zero that is
///               acne first, as it needs a larger bias as well
///
/// Falsely lit:
///   precision   the texel holds its exact value, and nothing is rounded in the comparison
///   resolution  the ray goes through the point itself
///   leak        there is no bias, nor a polygon offset; perhaps this needs that ray, too
///   open_mesh   both sides of casters are drawn; perhaps this needs a map that reaches further,
///               or the ray through the point, too
///   range       the map reaches the occluder; perhaps this needs that ray, too
std::vector<PixelCause> causes_of(const LightView& light, const Scene& scene,
                                  std::span<const WrongAnswer> answers);

/// Whether the light reaches the point of the receiver that was looked up, as far as its camera
/// sees.
bool light_reaches(const LightView& light, const Scene& scene, const Lookup& lookup,
                   const glm::dvec3& from_light, std::uint32_t receiver);

} // namespace shadowproof
