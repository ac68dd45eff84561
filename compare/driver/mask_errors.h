// By how much a driver may misread an alpha mask on a ray of a camera: texture coordinates are
// interpolated, wrapped and scaled in float, and so is alpha between texels.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "compare/driver/neighbourhood.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"
#include "scenes/roundoff.h"
#include "scenes/scene.h"

namespace shadowproof {

/// Finding a place among the texels rounds a coordinate four times: brought into one period, which
/// is up to 2 long, times the number of texels, less a half, and what is left above the texel.
inline constexpr double mask_place_roundings = 4 * 2 * float_roundoff;
/// Interpolating alpha, up to 1, rounds three times a difference, a product and a sum, of which two
/// follow each other.
inline constexpr double alpha_roundings = 6 * float_roundoff;

/// Of what a depth model draws before the scene's camera. Keeps a reference to the scene, which
/// must have masks.
class DriverMaskErrors final : public MaskErrors {
public:
    DriverMaskErrors(const Scene& scene, const DepthModel& depth_model, const Drawing& drawing);
    MaskError at(std::uint32_t triangle, const glm::dvec3& line) const override;

private:
    const Scene& scene_;
    DepthModel depth_model_;
    Drawing drawing_;
};

/// Whether a triangle's mask, if it has one, may leave it standing on some ray of the
/// neighbourhood. The tracer's scene may have the triangle turned over.
bool may_stand(const Tracer& tracer, const Neighbourhood& around, const MaskErrors& errors,
               std::uint32_t triangle);
/// The same of what a depth model draws, up to the far plane where that clips.
bool may_stand(const Tracer& tracer, const DepthModel& depth_model, double far,
               const Neighbourhood& around, std::uint32_t triangle);

} // namespace shadowproof
