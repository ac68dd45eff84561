// How large a texel of a shadow map is on the surface that it is asked for.
#pragma once

#include "compare/maps/light_view.h"

#include <glm/vec2.hpp>

namespace shadowproof {

/// How long the texel's middle row and its middle column are on a triangle's plane, as cut by the
/// rays from the light through the texel's borders; world units. Infinite where one of the rays
/// does not meet the plane.
glm::dvec2 footprint(const LightView& light, const Scene& scene, const Texel& texel,
                     std::uint32_t triangle);

/// How long a texel's side is on a surface that faces the light squarely, at that depth; world
/// units.
double width_at(const LightView& light, const Texel& texel, double depth);

} // namespace shadowproof
