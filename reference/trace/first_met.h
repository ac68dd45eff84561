// What rays from anywhere meet first: for pictures whose rays have no eye in common, as those of a
// light at infinity.
#pragma once

#include "reference/trace/any_rays.h"

#include <functional>
#include <span>
#include <vector>

namespace shadowproof {

/// Where a ray meets a triangle: origin + t direction, t rounded; no_triangle and infinity where it
/// meets none.
struct MetTriangle {
    std::uint32_t triangle = no_triangle;
    double t = std::numeric_limits<double>::infinity();
};

/// The first triangle that each ray meets within its limits, of those for which `counts` is true,
/// by exact signs. Of several at one place it is the lowest. A ray in a triangle's plane does not
/// meet it. Many rays use all of the tracer's threads, and `counts` is then called from each.
/// `stands`: whether the mask of a triangle that has one leaves it standing on a ray; null: exactly
/// (stands_on_ray).
std::vector<MetTriangle>
first_met(const Tracer& tracer, std::span<const AnyRay> rays,
          const std::function<bool(std::uint32_t)>& counts,
          const std::function<bool(const AnyRay&, std::uint32_t)>& stands = {});

/// Where the ray meets a triangle's plane, rounded; not finite where it runs in it.
double place_on_plane(const AnyRay& ray, const Corners& t);

} // namespace shadowproof
