// What a scene needs, decided before any work; what it does not need is left out, and reported.
// Every "not needed" is conservative: it is claimed only where it is certain.
#pragma once

#include "scenes/scene.h"
#include "scenes/technique_settings.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof {

struct Plan {
    bool hole_filling = true;      ///< some caster is open
    bool dark_cap = true;          ///< some volume may be seen all the way to infinity
    bool volume_meets_near = true; ///< some volume may contain a point of the near rectangle
    bool volume_meets_far = true;  ///< some volume may contain a point of the far rectangle
    /// From triangles_around_light. Unlike the rest it is a requirement: these triangles must be
    /// flipped.
    std::vector<std::uint8_t> around_light{};
    /// Whether depths must reach to infinity because of another light of the same picture.
    bool to_infinity = false;
    TechniqueSettings asked{};
    std::vector<std::string> left_out; ///< "tangents: no normal map", ... one clause each
    std::vector<std::string> faults;   ///< "caster 'lid' is open: ...", one line per faulty caster
};

Plan make_plan(const Scene& scene);

/// The far plane of techniques that have a finite one: the camera's own, else 1.5 times the largest
/// view depth of any vertex, and at least twice the near plane's.
double finite_far(const Scene& scene);

} // namespace shadowproof
