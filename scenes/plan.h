// What a scene needs, decided before any work; what it does not need is left out and said.
// Every "not needed" is conservative: it is claimed only where it is certain.
#pragma once

#include "scenes/lighting_settings.h"
#include "scenes/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof {

struct Plan {
    bool hole_filling = true;      ///< some caster is open
    bool dark_cap = true;          ///< some volume may be seen all the way to infinity
    bool volume_meets_near = true; ///< some volume may contain a point of the near rectangle
    bool volume_meets_far = true;  ///< some volume may contain a point of the far rectangle
    /// triangles_around_light: the one thing here that, where it is said, has to be done.
    std::vector<std::uint8_t> around_light{};
    LightingSettings lighting{}; ///< asked for by the user; nothing where all is left to techniques
    std::vector<std::string> left_out; ///< "tangents: no normal map", ... one clause each
    std::vector<std::string> faults;   ///< "caster 'lid' is open: ...", one line a faulty caster
};

Plan make_plan(const Scene& scene);

/// The far plane of the techniques that have a finite one: the camera's own, else 1.5 times the
/// largest view depth of any vertex, and at least twice the near plane's.
double finite_far(const Scene& scene);

} // namespace shadowproof
