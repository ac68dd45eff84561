#include "compare/judge/depends_on_shadow.h"

#include "reference/trace/any_rays.h"

namespace shadowproof {

bool depends_on_shadow(const TracedScene& traced, PixelPlace p) {
    const std::uint32_t triangle = traced.truth().triangle.at(p.x, p.y);
    if (triangle == no_triangle || !receives_shadows(traced.tracer(), triangle)) return false;
    const Image<std::uint8_t>& cones = traced.truth().in_cone;
    if (!cones.pixels.empty() && cones.at(p.x, p.y) == 0) return false;
    return sides_of(traced.tracer(), triangle).faces_light();
}

} // namespace shadowproof
