// The edge band of a pixel: all that a correct rasterizer may produce there, because it snaps
// vertices to a grid and rounds depths. Derived from both; nothing here is tuned.
#pragma once

#include "compare/driver/neighbourhood.h"
#include "reference/predict/prediction.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace shadowproof {

/// One value that the counter may have at a pixel, and how it comes about.
struct Reading {
    std::int64_t count = 0;   ///< before wrapping
    std::int64_t ideal = 0;   ///< the surface's shadow depth: what the count should be
    bool in_cone = true;      ///< the point is in the light's cone, if it is a spot
    bool by_rounding = false; ///< only if depths are rounded so
    /// The ray whose faces were counted, and the view depth of the surface shown there.
    glm::dvec3 direction{0, 0, 0};
    double depth = 0;
    /// Sum of the faces counted less that of the ray's own faces, in a counter without limits.
    std::int64_t off_ray = 0;
};

/// All readings that are possible at a pixel that shows the triangle read back.
struct PixelBand {
    std::vector<Reading> readings; ///< without repetition; none where it cannot be seen here
};

/// Where a pixel's counters come from.
struct PixelVolumes {
    RegionLedger& counted; ///< the volumes that the technique counts, around the pixel
    const Scene& casters;  ///< of those volumes
    const std::vector<glm::vec3>* far_ends = nullptr; ///< their far ends, null at infinity
    RegionLedger* ideal = nullptr;      ///< those of the casters, where they are not the same
    std::span<const FlatVolume> flat{}; ///< see Volumes::flat
    std::int32_t counted_at_eye = 0;    ///< shadow depths of the eye
    std::int32_t ideal_at_eye = 0;
};

/// `truth`: what trace_rays finds along the neighbourhood's rays. Stops at the first ray that has a
/// reading for which `matches` holds. If none has, it also tries rays between the outlines of
/// volumes; faces as several samples have them, if the counter saturates or the surface is seen
/// through a gap; and sides that are seen edge-on.
PixelBand find_band(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame,
                    double far, std::uint32_t shown, const Neighbourhood& around,
                    std::span<const RayTruth> truth,
                    const std::function<bool(const Reading&)>& matches);

} // namespace shadowproof
