#include "raster/maps/map_shadows.h"
#include "raster/technique.h"

#include <string_view>

namespace shadowproof {

namespace {

/// As cube_map_six_pass, but the comparisons with 4 x 4 texels around the point are averaged.
/// Beyond a face its border is repeated, as the document's GL_CLAMP_TO_EDGE does.
MapRecipe map() {
    return {.model = {.filter = 4}};
}

} // namespace

Technique cube_map_pcf_technique() {
    return {.name = "cube_map_pcf",
            .summary = "a cube map, whose comparisons are averaged over 4 x 4 texels",
            .source = "Percentage-closer filtering: Reeves et al. 1987; of a cube map: "
                      "omni-directional shadows with geometry shaders",
            .needs = "a light with a position",
            .cost = 3.2,
            .fails_at = joined(map_failings(), {Cause::filter, Cause::seam}),
            .by_nature = joined(map_failings_by_nature(), {Cause::filter, Cause::seam}),
            .lights = {Light::Kind::point, Light::Kind::spot},
            .sees_in_parallel = true,
            .settings = joined<std::string_view>(map_settings(),
                                                 {"map-filter", "map-average", "map-edges"}),
            .map = map};
}

} // namespace shadowproof
