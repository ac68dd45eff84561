#include "raster/maps/map_shadows.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// The light's depths in one square that holds the cone, looked up at the point projected into it:
/// s/r, t/r.
MapRecipe map() {
    return {.model = spot_model()};
}

} // namespace

Technique spot_map_technique() {
    return {.name = "spot_map",
            .summary = "a spot light's map of depths, looked up by projection",
            .source = "Williams 1978; CS448 lecture 11, shadow maps; Kilgard 2001",
            .needs = "a spot light with a cone narrower than 86 degrees to each side",
            .cost = 2.3,
            .fails_at = map_failings(),
            .by_nature = map_failings_by_nature(),
            .lights = {Light::Kind::spot},
            .sees_in_parallel = true,
            .settings = map_settings(),
            .map = map};
}

} // namespace shadowproof
