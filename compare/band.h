// The edge band of a pixel: what the rasterizer may make of it without being wrong, because it
// snaps vertices to a grid and rounds depths. Derived from both; nothing here is tuned.
#pragma once

#include "compare/neighbourhood.h"
#include "reference/prediction.h"
#include "reference/trace.h"
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
    std::int64_t ideal = 0;   ///< the surface's shadow depth: what the count ought to tell
    std::int32_t at_eye = 0;  ///< shadow depth of the eye
    bool in_cone = true;      ///< the light shines there, if it is a spot
    bool by_rounding = false; ///< only as floats round: depths, or the light's side of a caster
};

/// What the rasterizer may make of a pixel that shows the triangle read back.
struct PixelBand {
    std::vector<Reading> readings; ///< without repetition; none where it cannot be seen here
};

/// Where a pixel's counters come from.
struct PixelVolumes {
    RegionLedger& counted; ///< the volumes that the technique counts, around the pixel
    const Scene& casters;  ///< of those volumes
    const std::vector<glm::vec3>* far_ends = nullptr; ///< their far ends, null at infinity
    RegionLedger* ideal = nullptr;   ///< those of the casters, where they are not the same
    std::int64_t touching_light = 0; ///< how many casting triangles do
    std::int32_t counted_at_eye = 0; ///< shadow depths of the eye
    std::int32_t ideal_at_eye = 0;
};

/// `truth`: what trace_rays finds along the neighbourhood's rays. Looks no further than to the
/// first ray that has a reading for which `matches` holds; where none has, along rays between the
/// outlines of volumes, at faces as several samples have them, if the counter saturates or the
/// surface is seen through a gap, and at sides that are seen edge-on.
PixelBand find_band(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame,
                    double far, std::uint32_t shown, const Neighbourhood& around,
                    std::span<const RayTruth> truth,
                    const std::function<bool(const Reading&)>& matches);

} // namespace shadowproof
