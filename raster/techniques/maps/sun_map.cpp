#include "raster/maps/map_shadows.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// The light's depths in one square, drawn in parallel along the light, that is fitted to all that
/// casts or receives.
MapRecipe map() {
    return {.model = sun_model()};
}

} // namespace

Technique sun_map_technique() {
    return {.name = "sun_map",
            .summary = "a directional light's map of depths, in parallel projection",
            .source = "Williams 1978; CS448 lecture 11, shadow maps; the projection: orthographic",
            .needs = "a directional light",
            .cost = 1.2,
            .fails_at = map_failings(),
            .by_nature = map_failings_by_nature(),
            .lights = {Light::Kind::directional},
            .sees_in_parallel = true,
            .settings = without(map_settings(), {"map-value"}), // nothing has a distance from it
            .map = map};
}

} // namespace shadowproof
