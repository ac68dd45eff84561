#include "raster/technique.h"
#include "raster/traced/shadow_rays.h"

namespace shadowproof {

namespace {

/// A float ray tracer as in most tutorials: whatever a shadow ray meets within a constant of the
/// rounded hit point is taken for the surface itself.
Frame run(Gpu& /*gpu*/, const Scene& scene, const Plan& plan) {
    return trace_shadow_rays(scene, epsilon_recipe(scene, plan));
}

} // namespace

Technique traced_epsilon_technique() {
    return {.name = "traced_epsilon",
            .summary = "rays traced in float, hits within a constant of their start ignored",
            .source = "Embree's tutorials; Pharr & Humphreys 2004, RAY_EPSILON",
            .needs = "a constant that suits the scene's size",
            .cost = 5.1,
            .fails_at = {Cause::acne, Cause::leak, Cause::missed, Cause::precision},
            .by_nature = {Cause::acne, Cause::leak, Cause::missed},
            .sees_in_parallel = true,
            .settings = {"ray-epsilon"},
            .run = run};
}

} // namespace shadowproof
