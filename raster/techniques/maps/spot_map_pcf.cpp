#include "raster/maps/map_shadows.h"
#include "raster/technique.h"

#include <string_view>

namespace shadowproof {

namespace {

/// As spot_map, but the comparisons with 4 x 4 texels around the point are averaged: its claim is a
/// share of light.
MapRecipe map() {
    MapModel model = spot_model();
    model.filter = 4;
    return {.model = model};
}

} // namespace

Technique spot_map_pcf_technique() {
    return {.name = "spot_map_pcf",
            .summary = "a spot light's map, whose comparisons are averaged over 4 x 4 texels",
            .source = "Percentage-closer filtering: Reeves et al. 1987; CS448 lecture 11",
            .needs = "a spot light with a cone narrower than 86 degrees to each side",
            .cost = 2.6,
            .fails_at = joined(map_failings(), {Cause::filter}),
            .by_nature = joined(map_failings_by_nature(), {Cause::filter}),
            .lights = {Light::Kind::spot},
            .sees_in_parallel = true,
            .settings = joined<std::string_view>(map_settings(), {"map-filter", "map-average"}),
            .map = map};
}

} // namespace shadowproof
