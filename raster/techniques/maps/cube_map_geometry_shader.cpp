#include "raster/maps/map_shadows.h"
#include "raster/technique.h"

namespace shadowproof {

namespace {

/// As cube_map_six_pass, but the casters are drawn once: a geometry shader sends each triangle to
/// all six faces.
MapRecipe map() {
    return {.model = {}, .making = MapMaking::geometry_shader};
}

} // namespace

Technique cube_map_geometry_shader_technique() {
    return {.name = "cube_map_geometry_shader",
            .summary = "a cube map of distances from the light, drawn in a single pass",
            .source = "Omni-directional shadows with geometry shaders, method 2",
            .needs = "a light with a position, and geometry shaders",
            .cost = 1.44,
            .fails_at = map_failings(),
            .by_nature = map_failings_by_nature(),
            .lights = {Light::Kind::point, Light::Kind::spot},
            .sees_in_parallel = true,
            .settings = map_settings(),
            .map = map};
}

} // namespace shadowproof
