// What is seen from a point light: shadow maps keep it texel by texel, and shadow rays ask for it.
#pragma once

#include "compare/picture/predict.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace shadowproof {

struct LightView {
    /// Sides of single-sided casters that are left out.
    enum class Culled : std::uint8_t { none, front, back };
    Culled culled = Culled::none;
    int texels = 0; ///< along each side of a cube's faces; 0: as finely as floats do
    /// Texels by which faces are taken for narrower when they are asked, so that no neighbour of
    /// what is asked lies on another face: where the faces lie side by side in one picture.
    int inset = 0;
    double range = std::numeric_limits<double>::infinity(); ///< nothing is shadowed further away
};

/// The scene as the light sees it: casters alone.
Scene seen_from_light(const Scene& scene, LightView::Culled culled);

/// For each pixel of the patches that faces the light, in order: how much further from the light it
/// is than what the light sees there. Minus infinity: the light sees nothing, or it is beyond the
/// range. `light_tracer`: of seen_from_light.
std::vector<double> excesses(const TracedScene& traced, const Tracer& light_tracer,
                             const LightView& view, std::span<const Patch> patches);

/// Lit but where the light sees something that is closer to it by more than the bias.
Predict lit_within(const TracedScene& traced, const LightView& view, double bias);

} // namespace shadowproof
