// What each caster needs of a stencil technique, decided before drawing: whether anything visible
// may lie in its shadow, whether counting in front of the surface is enough, which caps can be
// omitted. Every "not needed" is certain.
#pragma once

#include "scenes/scene.h"

#include <string>
#include <vector>

namespace shadowproof {

/// One mesh as a caster.
struct CasterPlan {
    std::uint32_t mesh = 0;
    std::string left_out; ///< why nothing seen can lie in its shadow; empty where something may
    /// Its volume may contain the eye, a point of the near plane's rectangle, or a point between:
    /// then counting faces in front of a surface does not give the number of volumes around it.
    bool meets_near = true;
    bool reaches_infinity = true; ///< its volume may be seen at infinity
};

/// Plans of the meshes that cast, in the order of scene.meshes. Meshes that share a corner are one
/// body: those of it that are not left out agree in the last two members. Takes linear time, plus a
/// bounded number of comparisons between pairs of meshes, first of their boxes and then corner by
/// corner; a pair that is not compared counts as "may shadow".
std::vector<CasterPlan> plan_casters(const Scene& scene);

/// One flag per triangle: wherever a rasterizer draws it, it also draws it as a surface. It has no
/// alpha mask, is certainly not culled, and not past the camera's far plane unless that clips
/// everything
/// (`far_clips`). Its light cap has the same depths bit for bit, and so is never in front of the
/// visible surface.
std::vector<std::uint8_t> certain_surfaces(const Scene& scene, bool far_clips);

} // namespace shadowproof
