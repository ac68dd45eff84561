// What one pixel of a frame shows, and how the faces that are drawn relate to it: whether a face
// covers the pixel, and whether it is in front.
#pragma once

#include "compare/driver/nearness.h"
#include "compare/driver/pictured_face.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace shadowproof {

struct ShownPixel {
    glm::dvec2 centre{0, 0};
    double reach = 0; ///< how far aside, in pixels, the rasterizer may draw what it shows
    std::uint32_t triangle = no_triangle;
    double nearness = 0; ///< of the surface, as read back, or of the background
};

/// The background lies at `far`, the far plane, in finite projections, else at infinity.
ShownPixel shown_pixel(const Frame& frame, double far, int x, int y, double reach);

/// Pixels by the rows of the picture, as a face covers some of them alone.
class PixelsByRow {
public:
    /// `height`: of the picture.
    PixelsByRow(std::span<const ShownPixel> pixels, int height);

    /// The rows that a face may cover.
    PixelRun rows_of(const PicturedFace& face) const;
    /// Numbers of the pixels in them.
    std::span<const std::size_t> within(const PixelRun& rows) const;

private:
    std::vector<std::size_t> numbers_; ///< by row
    std::vector<std::size_t> first_;   ///< of each row, among the numbers
};

/// Whether something is so: never, perhaps, or always.
struct Chance {
    bool possible = false;
    bool certain = false;
};

/// Whether a face covers the pixel.
Chance covers(const PicturedFace& face, const ShownPixel& pixel);

/// How near a face may be there (nearness.h): anywhere where it is seen edge-on.
struct NearnessRange {
    double low = 0;
    double high = 0;
};
NearnessRange nearness_of(const PicturedFace& face, const ShownPixel& pixel,
                          const WindowRoundings& roundings);
/// Whether such a face is in front of what is shown.
Chance is_in_front(const NearnessRange& range, const ShownPixel& pixel);

/// Whether a face that may cover the pixel, or not, is off by more than the pixel's neighbourhood
/// is wide: then the truth there does not determine what is drawn.
bool is_coarse(const PicturedFace& face, const Chance& covered, const ShownPixel& pixel);

/// Whether a pixel may show what it shows, by the errors of all triangles that are seen.
struct SurfaceChance {
    bool is_coarse = false; ///< one of them is
    bool may_be_seen = true;
    /// Other triangles that may have the depth that is shown: a pass that draws what has just that
    /// depth draws them as well. In any order.
    std::vector<std::uint32_t> tied{};
};

/// Time is linear in pixels times triangles.
std::vector<SurfaceChance> surface_chances(const Tracer& tracer, const Frame& frame,
                                           std::span<const ShownPixel> pixels);

} // namespace shadowproof
