#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Counts volume faces behind the visible surface; the far plane is at infinity, where the dark cap
/// is just not clipped.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    return draw_stencil_shadows(
        gpu, scene,
        {.counting = {.test = Counting::Test::depth_fail,
                      .dark_cap = plan.dark_cap,
                      .flips = {.around_light = true}},
         .depth_model = {.projection = DepthModel::Projection::infinite, .near = scene.camera.near},
         .flipped = plan.around_light});
}

} // namespace

Technique zfail_infinite_technique() {
    return {.name = "zfail_infinite",
            .summary = "counts volume faces behind the surface, under an infinite projection",
            .source = "Everitt & Kilgard 2002; omni-directional shadows with geometry shaders",
            .needs = "closed volumes",
            .cost = 0.99,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh},
            .run = run};
}

} // namespace shadowproof
