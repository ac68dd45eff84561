#include "raster/technique.h"
#include "raster/traced/shadow_rays.h"

namespace shadowproof {

namespace {

/// A float ray tracer whose shadow rays pass through the triangle that they start on. Its
/// neighbours are not skipped.
Frame run(Gpu& /*gpu*/, const Scene& scene, const Plan& /*plan*/) {
    return trace_shadow_rays(scene, skip_recipe());
}

} // namespace

Technique traced_skip_technique() {
    return {.name = "traced_skip",
            .summary = "rays traced in float, which pass through their own triangle",
            .source = "Waechter & Binder 2019, on exclusion by primitive",
            .needs = "flat surfaces: neighbours of the triangle are met",
            .cost = 5.2,
            .fails_at = {Cause::acne, Cause::missed, Cause::precision},
            .by_nature = {Cause::acne, Cause::missed},
            .sees_in_parallel = true,
            .run = run};
}

} // namespace shadowproof
