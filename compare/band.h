// The edge band of a pixel: what the rasterizer may make of it without being wrong, because it
// snaps vertices to a grid and rounds depths. Derived from both; nothing here is tuned.
#pragma once

#include "reference/ledger.h"
#include "reference/trace.h"
#include "scenes/frame.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowproof {

/// How far, in pixels, the rasterizer may move what it draws at a world point sideways: half a
/// step of the snapping grid, and the float transform's error.
double lateral_freedom(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point);

/// How far, in view depth, two faces at a world point may be apart and yet be stored in either
/// order: the quantum of the depth format and the float transform's error.
double depth_freedom(const Scene& scene, const DepthModel& depth_model, const glm::dvec3& point);

/// Picture points at which a pixel's neighbourhood is looked at: its centre first, then a grid
/// that reaches `radius` pixels to each side.
inline constexpr std::size_t sample_count = 25;
std::array<glm::dvec3, sample_count> sample_directions(const Camera& camera, int x, int y,
                                                       double radius);

/// One value that the counter may have at a pixel, and how it comes about.
struct Reading {
    std::int64_t count = 0;  ///< before wrapping
    std::int64_t ideal = 0;  ///< the surface's shadow depth: what the count ought to tell
    std::int32_t at_eye = 0; ///< shadow depth of the eye
    bool moved_in_depth = false; ///< only with faces moved by their depths' freedom
};

/// What a pixel shows in the picture under judgement, and the truth around it.
struct PixelBand {
    std::array<RayTruth, sample_count> truth{}; ///< at the sample points
    bool surface_allowed = false; ///< the triangle read back is one that may be seen here
    std::vector<Reading> readings; ///< without repetition, for that triangle
};

/// `truth`: what trace_rays found along sample_directions(camera, x, y, radius).
PixelBand find_band(const Tracer& tracer, const Frame& frame, double far, int x, int y,
                    double radius, const std::array<RayTruth, sample_count>& truth);

} // namespace shadowproof
