// The edge band of a pixel: all that a correct rasterizer may produce there, because it snaps
// vertices to a grid and rounds depths. Derived from both; nothing here is tuned.
#pragma once

#include "compare/driver/neighbourhood.h"
#include "compare/stencil/pixel_faces.h"
#include "compare/stencil/reading.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace shadowproof {

/// All readings that are possible at a pixel that shows the triangle read back.
struct PixelBand {
    std::vector<Reading> readings; ///< without repetition; none where it cannot be seen here
};

/// Rays through all parts into which the outlines of volumes, as the frame counts them, divide the
/// neighbourhood.
std::vector<glm::dvec3> rays_between_outlines(const PixelVolumes& volumes, const Frame& frame,
                                              const Neighbourhood& around);

/// `truth`: what trace_rays finds along the neighbourhood's rays. Stops at the first ray that has a
/// reading for which `matches` holds. If none has, it also tries rays between the outlines of
/// volumes, and then all further readings of pixel_readings.h.
PixelBand find_band(const Tracer& tracer, const PixelVolumes& volumes, const Frame& frame,
                    double far, std::uint32_t shown, const Neighbourhood& around,
                    std::span<const RayTruth> truth,
                    const std::function<bool(const Reading&)>& matches);

} // namespace shadowproof
