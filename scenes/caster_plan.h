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
};

/// Of the meshes that cast, in the order of scene.meshes. Meshes that share a corner are one body:
/// what is not left out of it is alike in the last two. Linear in time but for pairs of meshes, of
/// which as many are compared, by their boxes and then corner by corner, as a fixed number of
/// comparisons allows; what is not compared is not left out.
std::vector<CasterPlan> plan_casters(const Scene& scene);

/// A flag a triangle: wherever a rasterizer draws it, it does so as a surface, too: it is not
/// culled for certain, and not past the camera's far plane unless that clips everything
/// (`far_clips`). Its light cap has the same depths bit for bit, and so is never in front of what
/// is seen.
std::vector<std::uint8_t> certain_surfaces(const Scene& scene, bool far_clips);

} // namespace shadowproof
