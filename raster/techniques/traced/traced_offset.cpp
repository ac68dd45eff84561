#include "raster/technique.h"
#include "raster/traced/shadow_rays.h"

namespace shadowproof {

namespace {

/// A float ray tracer that starts shadow rays a constant off the surface, along its normal.
Frame run(Gpu& /*gpu*/, const Scene& scene, const Plan& plan) {
    return trace_shadow_rays(scene, offset_recipe(scene, plan));
}

} // namespace

Technique traced_offset_technique() {
    return {.name = "traced_offset",
            .summary = "rays traced in float, started off the surface along its normal",
            .source = "Woo, Pearce & Ouellette 1996, It's Really Not a Rendering Bug, You See",
            .needs = "a distance that suits the scene's size",
            .cost = 5.3,
            .fails_at = {Cause::acne, Cause::leak, Cause::missed, Cause::precision},
            .by_nature = {Cause::acne, Cause::leak, Cause::missed},
            .sees_in_parallel = true,
            .settings = {"ray-offset"},
            .run = run};
}

} // namespace shadowproof
