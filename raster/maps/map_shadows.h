// Shadow maps: the passes (map, surface, light) as configured by a recipe.
#pragma once

#include "raster/gl/context.h"
#include "raster/lighting/lighting.h"
#include "raster/maps/map_pass.h"
#include "scenes/cause.h"
#include "scenes/frame.h"
#include "scenes/plan/plan.h"
#include "scenes/scene.h"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

namespace shadowproof {

/// Everything in which techniques with shadow maps differ.
struct MapRecipe {
    MapModel model; ///< where the user asked for nothing else (with_settings)
    MapMaking making = MapMaking::pass_per_face;
    /// What the map shows to be shadowed is drawn into the stencil buffer first, from which the
    /// light pass reads it. Spots alone.
    bool in_stencil = false;
    /// Colours in addition to the claim: only of bump-lit scenes, and where no block is filtered.
    std::optional<LightingRecipe> lighting{};
};

/// A spot's map as in the source documents: window depths of 24 bits.
inline MapModel spot_model() {
    return {.shape = MapModel::Shape::spot, .value = MapValue::depth, .format = MapFormat::d24};
}

/// A sun's map likewise; the format of whole numbers suits depths that are linear.
inline MapModel sun_model() {
    return {.shape = MapModel::Shape::sun, .value = MapValue::depth, .format = MapFormat::d24};
}

/// Two textures, and nothing but bytes: the casters' depths as steps of a ramp.
inline MapModel ramp_model() {
    return {.shape = MapModel::Shape::spot, .value = MapValue::depth, .format = MapFormat::ramp8};
}

/// What all of them are known to fail at: Technique::fails_at and by_nature. Open casters matter
/// where one of their sides is culled.
inline std::vector<Cause> map_failings() {
    return {Cause::resolution, Cause::acne,      Cause::leak,
            Cause::range,      Cause::open_mesh, Cause::precision};
}
inline std::vector<Cause> map_failings_by_nature() {
    return {Cause::resolution, Cause::acne, Cause::leak};
}

/// The flags that affect all of them (Technique::settings); a polygon offset those that hold
/// depths, or are asked to.
inline std::vector<std::string_view> map_settings() {
    return {"map-size",   "map-bias",    "map-slope-bias", "map-offset-units", "map-value",
            "map-format", "map-culling", "map-near",       "map-far"};
}
/// Those without these names.
inline std::vector<std::string_view> without(std::vector<std::string_view> settings,
                                             std::initializer_list<std::string_view> names) {
    std::erase_if(settings, [&](std::string_view each) {
        return std::ranges::find(names, each) != names.end();
    });
    return settings;
}
/// What techniques that average over a block have besides.
template <class T>
std::vector<T> joined(std::vector<T> list, std::initializer_list<T> more) {
    list.insert(list.end(), more);
    return list;
}

/// Draws the scene's surfaces as zfail_reversed does, and looks up the map in the light pass. Draws
/// once more beforehand, so that the driver finishes deferred compilation; the quickest of the
/// frames that the Gpu times is the time. Throws Error where the driver fails.
Frame draw_map_shadows(Gpu& gpu, const Scene& scene, const Plan& plan, const MapRecipe& recipe);

} // namespace shadowproof
