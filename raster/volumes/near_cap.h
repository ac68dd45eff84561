// Shadow volumes cut at the near plane and capped there, so that counting in front of the surface
// misses nothing (Kilgard 2001, "A New Robust Technique").
#pragma once

#include "scenes/depth_model.h"
#include "scenes/mesh/split_far_ends.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace shadowproof {

/// The part of the volumes' sides beyond the near plane, and the caps on it. Homogeneous points in
/// view space (the eye looks along -z); w = 0 at infinity, also within the near plane.
struct NearCut {
    std::vector<glm::vec4> points;
    std::vector<glm::uvec3> sides; ///< counter-clockwise from outside the volume
    std::vector<glm::uvec3> caps;  ///< facing the eye: one layer per volume
};

/// Cuts the volumes of `facing`, the triangles that face the chosen light. A cap is the cross
/// section of one triangle's volume. Its corners are where an edge of that volume passes the near
/// plane: a caster's corner projected from the light; a caster's edge that passes the plane itself;
/// or, where of two corners one projects and one does not, the point at infinity between their
/// directions, along the cross product of the plane's normal and that of the plane through the
/// light and both (Kilgard's third case). Each corner is computed once and shared by all faces that
/// meet in it, so no crack opens between caps, or between a cap and a side. The cross section of a
/// triangle whose far end is split may be half the plane, or all of it: its cap is a fan about the
/// plane's middle.
NearCut cut_at_near_plane(const Scene& scene, std::span<const std::uint32_t> welded,
                          std::span<const std::uint32_t> facing, const SplitFarEnds& split);

/// The scene's depths are drawn into [ledge, 1], which reserves the depths in front of it for the
/// caps. The reserve is needed because a steep surface that the near plane cuts is extrapolated to
/// pixels that its snapped corners cover, and there lies in front of that plane.
inline constexpr double ledge = 0x1p-6;

/// The near distance of a projection whose depths, drawn into [0, 1], equal those of the near
/// distance `near` drawn into [ledge, 1]: (f - n) F N / (f F - n N - n' (F - N)) with n' = 0,
/// n = ledge, f = 1 (the source prints the last term with the other sign).
/// Parallel depths are linear: (n' - n F) / (1 - n), n' being `near`.
double ledge_near(const DepthModel& model);

} // namespace shadowproof
