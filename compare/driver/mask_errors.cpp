#include "compare/driver/mask_errors.h"

#include "compare/driver/error_bounds.h"
#include "compare/driver/setup_error.h"
#include "reference/trace/faces.h"
#include "reference/trace/state.h"
#include "scenes/surface/alpha_mask.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace shadowproof {

DriverMaskErrors::DriverMaskErrors(const Scene& scene, const DepthModel& depth_model,
                                   const Drawing& drawing)
    : scene_(scene), depth_model_(depth_model), drawing_(drawing) {}

// What lies aside is told by the rays of the pixel's neighbourhood.
MaskError DriverMaskErrors::at(std::uint32_t triangle, const glm::dvec3& line) const {
    const double depth = depth_on_triangle(scene_, triangle, line);
    const double reach = lateral_error(scene_, depth_model_, point_on(scene_.camera, line, depth));
    const double share = attribute_error(scene_, triangle, {line, reach, drawing_});
    glm::dvec2 largest(0);
    for (const glm::dvec2& corner : mask_coordinates(scene_, triangle))
        largest = glm::max(largest, glm::abs(corner));
    return {share * largest + mask_place_roundings, alpha_roundings};
}

bool may_stand(const Tracer& tracer, const Neighbourhood& around, const MaskErrors& errors,
               std::uint32_t triangle) {
    const Tracer::State& state = tracer.state();
    if (!state.has_mask(triangle)) return true;
    const MaskedTriangle masked = state.masked(triangle);
    return std::ranges::any_of(around.rays, [&](const glm::dvec3& line) {
        return may_stand_on_ray(state.ray(line), masked, errors.at(triangle, line),
                                MaskReading::most);
    });
}

bool may_stand(const Tracer& tracer, const DepthModel& depth_model, double far,
               const Neighbourhood& around, std::uint32_t triangle) {
    if (!tracer.state().has_mask(triangle)) return true;
    const double cut = depth_model.clips_at_far() ? far : std::numeric_limits<double>::infinity();
    const DriverMaskErrors errors(tracer.scene(), depth_model,
                                  drawing_of(tracer.scene(), depth_model, cut));
    return may_stand(tracer, around, errors, triangle);
}

} // namespace shadowproof
