#include "raster/technique.h"
#include "raster/volumes/stencil.h"

namespace shadowproof {

namespace {

/// Counts volume faces behind the visible surface, so an eye in shadow is no special case, but the
/// far plane clips: s(surface) - s(far plane). It clips the whole dark cap, which is therefore not
/// drawn.
StencilRecipe recipe(const Scene& scene, const Plan& /*plan*/) {
    return {.counting = {.test = Counting::Test::depth_fail, .dark_cap = false},
            .depth_model = finite_depths(scene)};
}

} // namespace

Technique zfail_technique() {
    return {.name = "zfail",
            .summary = "counts volume faces behind the surface, up to a far plane that clips",
            .source = "Kilgard 2001, \"Carmack's reverse\"; VGP353 week 5",
            .needs = "closed volumes, and a far plane that cuts none of them",
            .cost = 1.08,
            .fails_at = {Cause::far_plane, Cause::precision, Cause::counter, Cause::open_mesh,
                         Cause::alpha, Cause::light_inside},
            .depth_model = finite_depths,
            .sees_in_parallel = true,
            .recipe = recipe};
}

} // namespace shadowproof
