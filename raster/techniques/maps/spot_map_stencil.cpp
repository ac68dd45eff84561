#include "raster/maps/map_shadows.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// As spot_map, but the answer of the map is drawn into the stencil buffer, and the light is drawn
/// where that is zero, as it is with shadow volumes.
MapRecipe map() {
    return {.model = spot_model(), .in_stencil = true};
}

} // namespace

Technique spot_map_stencil_technique() {
    return {.name = "spot_map_stencil",
            .summary = "a spot light's map of depths, whose answers the stencil buffer keeps",
            .source = "CS448 lecture 11, shadow map algorithm, step 4: set stencil",
            .needs = "a spot light with a cone narrower than 86 degrees to each side",
            .cost = 4.4,
            .fails_at = map_failings(),
            .by_nature = map_failings_by_nature(),
            .lights = {Light::Kind::spot},
            .sees_in_parallel = true,
            .settings = map_settings(),
            .map = map};
}

} // namespace shadowproof
