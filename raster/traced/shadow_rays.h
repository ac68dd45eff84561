// Shadows by tracing in float: an eye ray through each pixel, a shadow ray from the rounded hit
// point to the light.
#pragma once

#include "scenes/frame.h"
#include "scenes/plan/plan.h"
#include "scenes/scene.h"

#include <functional>

namespace shadowproof {

/// Where an eye ray met a surface, computed in float.
struct RoundedHit {
    glm::vec3 point{0, 0, 0};  ///< eye + t * direction, each product and sum rounded
    glm::vec3 normal{0, 0, 0}; ///< of the triangle, unit, on the side of the light
};

/// Everything in which traced techniques differ.
struct RayRecipe {
    RayModel model{}; ///< as the technique declares it
    std::function<FloatRay(const RayModel&, const RoundedHit&, const Light&)> shadow_ray;
    bool skips_own = false;        ///< shadow rays pass through the triangle that they start on
    bool tells_sides_apart = true; ///< sides that face away from the light are dark
};

/// The ray that the model describes: from the point (or off it) to the light, its direction a unit
/// vector. A light so near or far that floats have no such vector gives a direction of zero: no ray
/// is shot, and nothing is in the way.
FloatRay shadow_ray(const RayModel& model, const RoundedHit& hit, const Light& light);

RayRecipe epsilon_recipe(const Scene& scene, const Plan& plan);
RayRecipe offset_recipe(const Scene& scene, const Plan& plan);
RayRecipe skip_recipe();

/// On one thread; the time is that of building Embree's scene and of tracing. Throws Error where
/// Embree fails.
Frame trace_shadow_rays(const Scene& scene, const RayRecipe& recipe);

} // namespace shadowproof
