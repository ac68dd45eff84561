// What a point light sees, as sampled by the texels of a shadow map or by shadow rays.
#pragma once

#include "compare/picture/predict.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace shadowproof {

struct LightSampling {
    /// Sides of single-sided casters that are left out.
    enum class Culled : std::uint8_t { none, front, back };
    Culled culled = Culled::none;
    int texels = 0; ///< along each side of a cube's faces; 0: as finely as floats resolve
    /// Texels by which a lookup stays inside each face, so that no neighbouring texel lies on
    /// another face: for faces that lie side by side in one picture.
    int inset = 0;
    double range = std::numeric_limits<double>::infinity(); ///< nothing is shadowed further away
};

/// The scene as the light sees it: casters alone.
Scene seen_from_light(const Scene& scene, LightSampling::Culled culled);

/// For each pixel of the patches that faces the light, in order: how much further from the light it
/// is than what the light sees there. Minus infinity: the light sees nothing, or it is beyond the
/// range. `light_tracer`: of seen_from_light.
std::vector<double> excesses(const TracedScene& traced, const Tracer& light_tracer,
                             const LightSampling& view, std::span<const Patch> patches);

/// Lit, except where the light sees something that is closer to it by more than the bias.
Predict lit_within(const TracedScene& traced, const LightSampling& view, double bias);

} // namespace shadowproof
