// What is drawn where a triangle's shadow volume meets the near plane, by techniques that count in
// front of the surface and yet lose no faces.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "scenes/frame.h"
#include "scenes/scene.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

struct NearDrawing {
    NearPlane near_plane = NearPlane::lost;
    bool casters_near_light = false; ///< then occluders are drawn relative to the light
};

/// The part of the triangle between the light and the near plane, projected from the light onto
/// that plane: a convex polygon. Errors depend on how `drawn` finds it: from_light in floats,
/// capped in doubles that are rounded at the end. `cut`: whether what clips the triangle at the
/// near plane leaves the most or the least. Empty where all of it lies beyond the plane.
std::vector<ViewCorner> near_layer(const Scene& casters, std::uint32_t triangle,
                                   const NearDrawing& drawn, PlaneCut cut);

/// Whether the light lies so near the triangle's plane that doubles, in which volumes are cut at
/// the near plane, do not determine its side: the cut may then have any result.
bool is_flat_from_light(const Scene& casters, std::uint32_t triangle);

/// Whether the light lies in the near plane, so that no shadow falls on it anywhere but in a line,
/// or so near it that doubles do not tell to 1/256 pixel where one falls.
bool is_in_near_plane(const Scene& casters);

} // namespace shadowproof
