#include "raster/maps/map_shadows.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// The casters are drawn six times, once from the light along each axis, and a point is shadowed
/// where its texel is nearer to the light by more than the bias.
MapRecipe map() {
    return {};
}

} // namespace

Technique cube_map_six_pass_technique() {
    return {.name = "cube_map_six_pass",
            .summary = "a cube map of distances from the light, drawn face by face",
            .source = "Omni-directional shadows with geometry shaders, method 1",
            .needs = "a light with a position",
            .cost = 1.33,
            .fails_at = map_failings(),
            .by_nature = map_failings_by_nature(),
            .lights = {Light::Kind::point, Light::Kind::spot},
            .sees_in_parallel = true,
            .settings = map_settings(),
            .map = map};
}

} // namespace shadowproof
