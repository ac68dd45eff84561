#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Counts volume faces behind the visible surface; depth clamping keeps faces past the far plane,
/// so the whole volume is counted. Where no volume reaches that plane, nothing is clamped.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    return draw_stencil_shadows(gpu, scene,
                                {.counting = {.test = Counting::Test::depth_fail,
                                              .dark_cap = plan.dark_cap,
                                              .flips = {.around_light = true}},
                                 .depth_model = {.near = scene.camera.near,
                                                 .far = finite_far(scene),
                                                 .clamp = plan.volume_meets_far},
                                 .flipped = plan.around_light});
}

} // namespace

Technique zfail_clamp_technique() {
    return {.name = "zfail_clamp",
            .summary = "counts volume faces behind the surface, depths clamped to near and far",
            .source = "Everitt & Kilgard 2002; omni-directional shadows with geometry shaders",
            .needs = "closed volumes, and GL_DEPTH_CLAMP",
            .cost = 1,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh},
            .run = run};
}

} // namespace shadowproof
