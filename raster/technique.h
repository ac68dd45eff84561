// A technique: what it is called, what it needs, what it is known to fail at, and the function that
// draws or traces a scene with it. Its frames name the family that judges its claim
// (Frame::family).
#pragma once

#include "scenes/cause.h"
#include "scenes/depth_model.h"
#include "scenes/frame.h"
#include "scenes/plan/plan.h"
#include "scenes/scene.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace shadowproof {

class Gpu;
struct LightingRecipe;
struct MapRecipe;
struct StencilRecipe;

struct Technique {
    std::string_view name;    ///< "zfail_reversed"
    std::string_view summary; ///< one clause: how it works
    std::string_view source;  ///< where it is described
    std::string_view needs;   ///< what it requires of scene and driver
    /// Frame time relative to zfail_reversed, the geometric mean over all bundled scenes that it
    /// suits under each of their lights, at 512x512, as measured by shadowproof_technique_bench. 0:
    /// not measured.
    double cost = 0;
    std::vector<Cause> fails_at; ///< its known causes of failure
    /// Those of them that almost any scene provokes: no scene need declare them.
    std::vector<Cause> by_nature = {};
    bool needs_bump_maps = false; ///< it lights them, and is for bump-lit scenes only
    /// It reflects the scene's environment. A technique that lights bump maps without reflections
    /// is only for scenes without an environment.
    bool needs_environment = false;
    bool filters_bumps = false; ///< from mipmaps; unless named, it is for files that ask for these
    /// The numbers in which it tells apart the depths of volumes and surfaces; null: it counts no
    /// volumes.
    DepthModel (*depth_model)(const Scene& scene) = nullptr;
    bool squares_thrice = false;          ///< its highlights have the exponent 8 alone
    std::vector<Light::Kind> lights = {}; ///< it is for these alone; empty: for all
    bool sees_in_parallel = false;        ///< it draws what orthographic cameras see, too
    /// The flags that affect it, but not all techniques; without their dashes.
    std::vector<std::string_view> settings = {};
    /// How it counts, if it is one of stencil shadow volumes.
    StencilRecipe (*recipe)(const Scene& scene, const Plan& plan) = nullptr;
    bool counts_in_sum = false;   ///< not in a stencil, by which bumps could be lit
    MapRecipe (*map)() = nullptr; ///< if it draws a shadow map
    /// How it lights bumps; null: it shows visibility alone.
    LightingRecipe (*lighting)(const Plan& plan) = nullptr;
    /// Tells more of a frame that its recipe drew: what it leaves out, what that saves.
    void (*remark)(Gpu& gpu, const Technique& technique, const Scene& scene, const Plan& plan,
                   Frame& frame) = nullptr;
    /// Draws or traces a scene, where there is no recipe.
    Frame (*run)(Gpu& gpu, const Scene& scene, const Plan& plan) = nullptr;
};

inline bool is_for(const Technique& technique, Light::Kind kind) {
    const std::vector<Light::Kind>& lights = technique.lights;
    return lights.empty() || std::find(lights.begin(), lights.end(), kind) != lights.end();
}

/// The light that is judged and, if the technique lights bumps, those before it, which are added
/// up.
inline std::span<const Light> added_lights(const Technique& technique, const Scene& scene) {
    const std::size_t first = technique.lighting != nullptr && is_bump_lit(scene) ? 0 : scene.light;
    return std::span(scene.lights).subspan(first, scene.light + 1 - first);
}

/// The first of these that it is not for; null: it is for all.
inline const Light* unsuited_light(const Technique& technique, const Scene& scene) {
    for (const Light& light : added_lights(technique, scene))
        if (!is_for(technique, light.kind)) return &light;
    return nullptr;
}

/// Whether a technique can draw such a scene.
inline bool can_draw(const Technique& technique, const Scene& scene) {
    if (unsuited_light(technique, scene) != nullptr) return false;
    if (scene.camera.is_orthographic() && !technique.sees_in_parallel) return false;
    if (!technique.needs_bump_maps) return true;
    return is_bump_lit(scene) && technique.needs_environment == scene.environment.has_value() &&
           !(technique.squares_thrice && scene.highlight.exponent() != 8);
}

/// Whether it is for such a scene; if not, it is left out unless requested by name.
bool suits(const Technique& technique, const Scene& scene);

/// Whether one of them filters the scene's bump maps, so that right colours are means over pixels.
inline bool filter_bumps(std::span<const Technique* const> techniques, const Scene& scene) {
    return std::any_of(techniques.begin(), techniques.end(), [&](const Technique* one) {
        return one->filters_bumps && can_draw(*one, scene);
    });
}

inline bool heeds(const Technique& technique, std::string_view setting) {
    return std::find(technique.settings.begin(), technique.settings.end(), setting) !=
           technique.settings.end();
}

/// All techniques in the order of the registry, techniques.inc.
std::span<const Technique> all_techniques();

/// One that lights bumps, joined by + with one that counts volumes in a stencil, or asks a map that
/// is not filtered, is a technique too: "bump_three_pass+zpass". Null where no technique has that
/// name.
const Technique* find_technique(std::string_view name);

/// The names of those that may stand before a +, and behind it.
std::vector<std::string_view> lighting_techniques();
std::vector<std::string_view> shadowing_techniques();

} // namespace shadowproof
