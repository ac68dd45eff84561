// Why an answer of a shadow map is wrong: by its counterfactuals.
#pragma once

#include "compare/judge/judge.h"
#include "compare/maps/lookup.h"

namespace shadowproof {

/// A wrong answer: what asked, and what it was told.
struct WrongAnswer {
    std::uint32_t receiver = no_triangle;
    glm::dvec3 from_light{0, 0, 0}; ///< the point that asked
    Lookup lookup;                  ///< its exact own
    LightView::Shown shown;         ///< by the texel that was asked
    bool claims_light = false;      ///< falsely lit, else falsely shadowed
};

/// The first of these that makes the answer right. Where a block is averaged, its own texel alone
/// (filter); what follows is of that texel's answer. Falsely shadowed: a map that reaches the point
/// (range), exact values (precision); else the ray through the point itself, as no caster lies on
/// it: acne where the texel shows the receiver or a triangle that has a corner in common with it,
/// resolution where it shows another. Falsely lit: exact values (precision), the ray through the
/// point itself (resolution), no bias (leak, which may need that ray, too), casters drawn from all
/// sides (open_mesh), a map that reaches the occluder (range).
PixelCause cause_of(const LightView& light, const Scene& scene, const WrongAnswer& wrong);

} // namespace shadowproof
