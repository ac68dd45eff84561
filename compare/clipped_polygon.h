// What a rasterizer's clipper leaves of a triangle, with the roundings of its floats: the corners
// that it makes lie between two others, and are off as the larger of those is long.
#pragma once

#include "scenes/frame.h"
#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <vector>

namespace shadowproof {

/// What of a picture's making bears on clipping.
struct Drawing {
    double near = 0; ///< depths of planes that clip; 0 where depths are clamped instead
    double far = std::numeric_limits<double>::infinity();
    double offset = 0; ///< size of the eye's coordinates, where positions are transformed with them
    /// The projection's near plane where window depth rises with depth; 0 where it is reversed.
    double standard_near = 0;
};

/// `far`: of what is drawn, infinite where no plane clips there.
Drawing drawing_of(const Scene& scene, const Frame& frame, double far);

/// A point of the picture, in pixels, and the inverse of its view depth, which is linear there as
/// window depth is.
struct PicturePoint {
    glm::dvec2 place{0, 0};
    double inverse_depth = 0;
    double place_error = 0; ///< of the float transform, as lateral_freedom has it, and of clipping
    double depth_error = 0; ///< of both and the window's roundings, as depth_freedom has it
    bool made_by_clipping = false;
};

/// `corners`: homogeneous world points (p, w). Clipped by the planes in depth, and by a guard band
/// twice the picture's size, as Mesa's draw module has it (draw_pt_post_vs: x and y to twice w).
/// Empty where nothing is left.
std::vector<PicturePoint> clipped_polygon(const Camera& camera,
                                          const std::array<glm::dvec4, 3>& corners,
                                          const Drawing& drawing);

/// The triangles as which a side of a volume may be drawn, over the edge from corner `first` of a
/// triangle to the next: a side is two, and which diagonal parts them hangs on the order of
/// positions. `far_ends`: where the casters' positions lie once extruded, null where that is at
/// infinity.
std::array<std::array<glm::dvec4, 3>, 4> triangles_of_side(const Scene& casters,
                                                           const std::vector<glm::vec3>* far_ends,
                                                           std::uint32_t triangle, int first);

} // namespace shadowproof
