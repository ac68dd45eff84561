#include "raster/stencil.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// zfail_infinite where numbers are dense: depth n/t in floating point, far things near zero, and
/// vertices made relative to the eye before the matrix rounds them.
Frame run(Gpu& gpu, const Scene& scene, const Plan& plan) {
    ShadowVolume volume = extrude(scene);
    if (!plan.dark_cap) volume.dark_cap.clear();
    return draw_stencil_shadows(
        gpu, scene, volume,
        {.counting = {.test = Counting::Test::depth_fail},
         .steps = {.front = -1, .back = +1},
         .depth_model = {.projection = DepthModel::Projection::infinite_reversed,
                         .near = scene.camera.near,
                         .floating = true,
                         .eye_relative = true}});
}

} // namespace

Technique zfail_reversed_technique() {
    return {.name = "zfail_reversed",
            .summary = "zfail_infinite with reversed floating depth and eye-relative vertices",
            .source = "Everitt & Kilgard 2002, with the depth range reversed",
            .needs = "closed volumes, glClipControl and a D32F depth buffer",
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh},
            .run = run};
}

} // namespace shadowproof
