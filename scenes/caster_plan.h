// What each caster needs of a stencil technique, decided before drawing: whether anything that is
// seen may lie in its shadow, whether counting in front of the surface is enough, which caps it can
// do without. Every "not needed" is certain.
#pragma once

#include "scenes/scene.h"

#include <string>
#include <vector>

namespace shadowproof {

/// One mesh as a caster.
struct CasterPlan {
    std::uint32_t mesh = 0;
    std::string left_out; ///< why nothing seen can lie in its shadow; empty where something may
    /// Its volume may hold the eye or a point of the near plane's rectangle, or of what lies
    /// between: faces in front of a surface do not tell how often the surface is in shadow.
    bool meets_near = true;
    bool reaches_infinity = true; ///< its volume may be seen at infinity
    /// A triangle of it that faces the light may be culled and lie in front of what is seen.
    bool cap_in_front = true;
};

/// Of the meshes that cast, in the order of scene.meshes. Meshes that share a corner are one body:
/// what is not left out of it is alike in the last three. Linear in time but for pairs of small
/// meshes, of which each triangle is held against each corner of the other.
std::vector<CasterPlan> plan_casters(const Scene& scene);

} // namespace shadowproof
