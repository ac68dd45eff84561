#include "raster/maps/map_shadows.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// A spot's map for hardware that compares no depths: its texels are bytes of a colour, the step of
/// a ramp texture in which a depth lies, and a second texture gives the point's own step.
MapRecipe map() {
    return {.model = ramp_model()};
}

} // namespace

Technique spot_map_dual_texture_technique() {
    return {.name = "spot_map_dual_texture",
            .summary = "a spot light's map of 8-bit depths, compared by a second texture",
            .source = "Heidrich 1999; Kilgard 2001, shadow mapping with dual-texturing hardware",
            .needs = "a spot light with a cone narrower than 86 degrees to each side",
            .cost = 3.4,
            .fails_at = map_failings(),
            .by_nature = map_failings_by_nature(),
            .lights = {Light::Kind::spot},
            .sees_in_parallel = true,
            .settings = without(map_settings(),
                                {"map-slope-bias", "map-offset-units", "map-value", "map-format"}),
            .map = map};
}

} // namespace shadowproof
