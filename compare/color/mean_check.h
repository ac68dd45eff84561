// How far the colours of a frame are off the means over their pixels, as it can show them, by how
// many texels a pixel covers and by how slanted it sees the surface.
#pragma once

#include "compare/color/color_verdict.h"
#include "reference/shade/pixel_means.h"
#include "scenes/frame.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// Pixels of some range, from `from` to below `to`.
struct ErrorBin {
    double from = 0;
    double to = 0;
    std::uint64_t pixels = 0;
    double rmse = 0; ///< over their channels, in steps of 1/255
};

/// Pixels whose surface and visibility are the truth's.
struct MeanCheck {
    int most_rays = 0;       ///< of a pixel
    double noise = 0;        ///< PixelMeans::noise
    double rmse = 0;         ///< of all these pixels, in steps of 1/255
    std::uint64_t alike = 0; ///< those whose rays are all alike (PixelMeans::share_alike)
    double alike_rmse = 0;   ///< of these
    /// Of these, where they see a bump map: by texels along the pixel's longer side, each to twice
    /// as many; and by the angle between ray and surface normal, in degrees. Without those that are
    /// empty.
    std::vector<ErrorBin> by_texels{};
    std::vector<ErrorBin> by_angle{};
};

/// `verdicts`: of the frame's colours.
MeanCheck check_means(const PixelMeans& means, const Frame& frame,
                      const Image<ColorVerdict>& verdicts);

} // namespace shadowproof
