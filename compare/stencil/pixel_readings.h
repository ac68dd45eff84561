// What the counter may read at a pixel, by what a correct rasterizer may draw there. Each function
// appends the readings of one way in which pixels come out other than along their centre's ray.
#pragma once

#include "compare/stencil/pixel_faces.h"
#include "compare/stencil/reading.h"

#include <span>
#include <vector>

namespace shadowproof {

/// The pixel is covered as the sample's ray is, and depths are rounded.
void add_sample(const PixelFaces& pixel, const Sample& sample, std::vector<Reading>& readings);

/// The counter stops at its limits, and each face is as in one of the samples, not all in the same
/// one: a step down that no single ray meets together with the following step up changes where the
/// counter stops. The sum of the faces is that of some sample, as the volumes stay closed.
void add_mixed_samples(const PixelFaces& pixel, std::span<const RayTruth> truth,
                       std::vector<Reading>& readings);

/// The shown surface is seen through a gap, on no sample's ray. The gap lies between surfaces that
/// move apart, so each face may be as in any of the samples, and the caps of those surfaces are not
/// drawn.
void add_in_gap(const PixelFaces& pixel, std::span<const RayTruth> truth,
                std::vector<Reading>& readings);

/// Each reading that is there, with sides that are seen edge-on, or over an edge that points at the
/// light: no sample's ray meets these, but snapping may make slivers of them that face either way.
void add_edge_on_sides(const PixelFaces& pixel, std::vector<Reading>& readings);

/// Each reading that is there, with caps that are slivers: light caps, which snapping may flip, or
/// whose surface may come out behind what is shown; dark caps, which may be drawn at any depth; and
/// layers in the near plane.
void add_slivers(const PixelFaces& pixel, std::vector<Reading>& readings);

/// Each reading that is there, with from `least` to `most` more faces in front of the surface.
/// `by_depth`: as Reading has it.
void add_moved(const Counting& counting, std::int64_t least, std::int64_t most, bool by_depth,
               std::vector<Reading>& readings);

} // namespace shadowproof
