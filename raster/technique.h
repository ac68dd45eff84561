// A technique: how the shadow volumes are counted, what it is known to fail at, what it needs, and
// the function that draws it.
#pragma once

#include "scenes/cause.h"
#include "scenes/frame.h"
#include "scenes/plan.h"
#include "scenes/scene.h"

#include <span>
#include <string_view>
#include <vector>

namespace shadowproof {

class Gpu;

struct Technique {
    std::string_view name;    ///< "zfail_reversed"
    std::string_view summary; ///< one clause: how it counts
    std::string_view source;  ///< where it is described
    std::string_view needs;   ///< what it asks of scene and driver
    /// Time of a frame against zfail_reversed's, as the geometric mean over all bundled scenes that
    /// it suits under each of their lights, at 512x512: as shadowproof_technique_bench measured it.
    /// 0: not measured.
    double cost = 0;
    std::vector<Cause> fails_at; ///< the causes it is known to have
    /// Of those, what it has on almost any scene: no scene need declare that it provokes it.
    std::vector<Cause> by_nature = {};
    bool needs_bump_maps = false; ///< it lights them, and is for scenes that are bump-lit alone
    /// It reflects one. Who lights bumps and does not reflect is not for scenes that have one.
    bool needs_environment = false;
    Frame (*run)(Gpu& gpu, const Scene& scene, const Plan& plan) = nullptr;
};

/// Whether a technique is for such a scene; if not, it is left out unless asked for by name.
inline bool suits(const Technique& technique, const Scene& scene) {
    return !technique.needs_bump_maps ||
           (is_bump_lit(scene) && technique.needs_environment == scene.environment.has_value());
}

/// All techniques in the order of the registry, techniques.inc.
std::span<const Technique> all_techniques();

/// Null where no technique has that name.
const Technique* find_technique(std::string_view name);

} // namespace shadowproof
