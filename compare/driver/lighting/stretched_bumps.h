// Bumps of heights in units of space: how steep they are where a triangle stretches or skews the
// texels of its bump map.
#pragma once

#include "compare/driver/interval.h"
#include "compare/driver/lighting/lighting_ranges.h"
#include "compare/driver/lighting/vector_range.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec2.hpp>

namespace shadowproof {

/// The perturbed normal in the frame's axes, not normalised, by Blinn's formula (height_gradient in
/// texel_sides.h). `slope`: heights per texel along a row and down the rows. `frame`: of the seen
/// side, in world axes; the normal may be off by its normal_off, and floats are counted unless that
/// is 0. `side`: -1 where the back is seen.
VectorRange normal_over_texel_sides(const Scene& scene, std::uint32_t triangle,
                                    const TangentFrame& frame, double side,
                                    const RangeOf<glm::dvec2>& slope);

} // namespace shadowproof
