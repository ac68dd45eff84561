// By how much texture coordinates differ between neighbours of a quad, the two by two pixels of
// which a driver takes derivatives (OpenGL 4.5, section 8.14.1 leaves the rest to it): all have the
// triangle's own plane, also those that the triangle does not cover.
#pragma once

#include "compare/driver/interval.h"
#include "compare/driver/setup_error.h"
#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// The rays of a pixel and of its neighbours in its quad, as a rasterizer may draw them. Rays of a
/// square of the picture are a square, too: that of column x and row y is linear in both.
struct QuadRays {
    std::array<glm::dvec3, 4> rays{}; ///< of the pixel: the corners of a square around its centre
    glm::dvec3 to_column{0, 0, 0};    ///< from one of them to the same of the neighbour in its row
    glm::dvec3 to_row{0, 0, 0};       ///< and in its column
    /// Snapping moves corners of a triangle, and so its places, linearly between them: how much
    /// further apart than a pixel, along each axis, two neighbours' places may be drawn, in pixels.
    double stretch = 0;
    double share = 0; ///< largest relative rounding error of interpolated values in the quad
};

/// The quad of a pixel of a picture of so many rows: columns and rows pair up from OpenGL's first,
/// which is the picture's last.
struct QuadNeighbours {
    int column = 1; ///< 1: the next; -1: the one before
    int row = 1;
};
inline QuadNeighbours quad_neighbours(int x, int y, int rows) {
    return {x % 2 == 0 ? 1 : -1, (rows - 1 - y) % 2 == 0 ? -1 : 1};
}

/// Such a stretch of a triangle at a pixel, by as much as the pixel's reach says. Infinite where
/// the triangle is no wider than that, or nothing of it is drawn.
double drawn_stretch(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel);

/// Differences of a pair of texture coordinates, of the neighbour from the pixel. Not finite where
/// the triangle's plane may end between them.
struct PlaceSteps {
    PlaceRange across{any_number, any_number}; ///< in the pixel's row
    PlaceRange down{any_number, any_number};   ///< in its column
};
/// `values`: at the triangle's corners.
PlaceSteps quad_steps(const Scene& scene, std::uint32_t triangle,
                      const std::array<glm::dvec2, 3>& values, const QuadRays& quad);

} // namespace shadowproof
