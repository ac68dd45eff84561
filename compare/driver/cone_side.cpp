#include "compare/driver/cone_side.h"

#include "compare/driver/error_bounds.h"
#include "compare/driver/setup_error.h"
#include "reference/trace/faces.h"
#include "scenes/camera.h"
#include "scenes/driver.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

// A point at d from the light is in the cone where d . axis - cos |d| is not negative. That changes
// by at most 1 + |cos| times what the point is off; both products, sums and the length round d by
// less than 8 v of it.
ConeSides cone_sides(const Scene& scene, const DepthModel& model, double far,
                     std::uint32_t triangle, int x, int y) {
    const Light& light = chosen_light(scene);
    if (light.kind != Light::Kind::spot) return {};
    const glm::dvec3 line = line_of_sight(scene.camera, x + 0.5, y + 0.5);
    const double depth = depth_on_triangle(scene, triangle, line);
    const bool is_met = scene.camera.is_orthographic() ? std::isfinite(depth) : depth > 0;
    if (!is_met) return {true, true}; // its plane is not met: it is drawn aside
    const glm::dvec3 point = point_on(scene.camera, line, depth);
    const double clips_at = model.clips_at_far() ? far : std::numeric_limits<double>::infinity();
    const CoveredPixel pixel{line, lateral_error(scene, model, point),
                             drawing_of(scene, model, clips_at)};
    const glm::dvec3 from_light = point - light.position;
    const double error =
        std::sqrt(3.0) * interpolated_place_error(scene, triangle, pixel, light.position) +
        8 * float_roundoff * glm::length(from_light);
    const double cosine = std::cos(light.outer_cone);
    const double inside = glm::dot(from_light, light.direction) - cosine * glm::length(from_light);
    const double off = (1 + std::abs(cosine)) * error;
    return {!(inside < -off), !(inside > off)}; // both where it is no number
}

} // namespace shadowproof
