// Two ways to count what the near plane cuts off: cap the volumes there, or draw from the light
// what lies between it and the plane.
#pragma once

#include "raster/passes.h"
#include "raster/volume.h"
#include "raster/volume_pass.h"

namespace shadowproof {

/// The volumes' sides beyond the near plane, among the scene's depths; the caps on it, drawn at the
/// front of the ledge before them; then the light caps. The scene must be drawn into
/// [ledge, 1] (near_cap.h). Finite projections only. Kilgard 2001.
VolumePass make_capped_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                            const ClipTransform& transform, const DepthModel& depth_model,
                            const SpecialCaps& special);

/// Draws the casters between light and near plane as the light sees them through it: one layer at
/// a pixel for each volume that holds its point of the near plane. Draws nothing where the light
/// lies in the near plane itself. Hornus, Hoberock, Lefebvre & Hart 2005, "ZP+".
VolumePass make_occluder_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry);

} // namespace shadowproof
