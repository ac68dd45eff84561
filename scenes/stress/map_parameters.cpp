#include "scenes/shadow_map.h"
#include "scenes/stress/parameters.h"

namespace shadowproof {

namespace {

bool has_any_light(const Scene& /*scene*/) {
    return true;
}

double as_it_is(const Scene& /*scene*/, double value) {
    return value;
}

/// A map of the light as techniques make it where nothing is asked; one around it holds any light
/// that has a position.
MapModel own_map(const Scene& scene) {
    const bool is_sun = chosen_light(scene).kind == Light::Kind::directional;
    MapModel model;
    if (is_sun) model = {.shape = MapModel::Shape::sun, .value = MapValue::depth};
    return with_settings(model, {}, scene);
}

} // namespace

std::vector<StressParameter> map_parameters() {
    return {
        {.name = "map_size",
         .words = "texels a side of shadow maps",
         .low = 4,
         .high = 4000,
         .whole = true,
         .suits = has_any_light,
         .own = [](const Scene& scene) { return static_cast<double>(own_map(scene).size); },
         .flag = "map-size",
         .flag_value = as_it_is},
        {.name = "map_bias",
         .words = "how much farther than its texel a point may be and still be lit, in the file's "
                  "units",
         .low = 1e-6,
         .high = 1e3,
         .down_to_zero = true,
         .suits = has_any_light,
         .own = [](const Scene& scene) { return own_map(scene).bias * scene.unit; },
         .flag = "map-bias",
         .flag_value = as_it_is},
        {.name = "map_range",
         .words = "the reach of shadow maps, in those that end just beyond the farthest caster",
         .low = 1e-2,
         .high = 1e6,
         .suits = has_any_light,
         .own = [](const Scene&) { return 1.0; },
         .flag = "map-far",
         .flag_value = [](const Scene& scene,
                          double value) { return value * own_map(scene).far * scene.unit; }},
    };
}

} // namespace shadowproof
