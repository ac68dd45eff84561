// Two ways to count what the near plane cuts off: cap the volumes on it, or draw, from the light,
// the casters between the light and the plane.
#pragma once

#include "raster/passes/passes.h"
#include "raster/volumes/volume.h"
#include "raster/volumes/volume_pass.h"
#include "scenes/mesh/split_far_ends.h"

namespace shadowproof {

/// Draws the volumes' sides beyond the near plane, among the scene's depths; the caps on it, at the
/// front of the depths reserved before them (`ledge`); then the light caps. The scene must be drawn
/// into [ledge, 1] (near_cap.h). Finite projections only. Kilgard 2001.
VolumePass make_capped_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                            const ClipTransform& transform, const DepthModel& depth_model,
                            const SpecialCaps& special, const SplitFarEnds& split);

/// Draws the casters between light and near plane from the light, through that plane: at each
/// pixel, one layer for each volume that contains the pixel's point on the near plane. Hornus,
/// Hoberock, Lefebvre & Hart 2005, "ZP+". A triangle with a split far end is drawn as a pyramid
/// along just those directions, between light and plane: what it covers it covers next to the
/// light. `first`: the number of the first of its occluder_points. `near_light`:
/// casters_near_light.
VolumePass make_occluder_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                              const SplitFarEnds& far_ends, std::uint32_t first, bool near_light);

/// Whether floats place what make_occluder_pass draws near the picture to within a pixel. The
/// nearer the light is to the near plane, the further aside a rounding throws what is projected
/// onto it.
bool places_occluders(const Scene& scene);

/// Points between light and near plane: first along the directions of a split, then along those of
/// the corners of each triangle that is split.
std::vector<glm::vec3> occluder_points(const Scene& scene, const SplitFarEnds& split);

} // namespace shadowproof
