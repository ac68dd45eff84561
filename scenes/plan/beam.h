// Conservative tests of what may lie between the light and a part of the picture: "no" is certain,
// for the rasterizer's floats, too.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace shadowproof {

using TriangleCorners = std::array<glm::dvec3, 3>;

TriangleCorners corners_of(const Scene& scene, std::uint32_t triangle);

/// All points between the light and some point of a part of the picture: a convex hull, relative to
/// `origin`.
struct Beam {
    /// A direction along which the hull may be separated from something, and the range that it
    /// covers there.
    struct Axis {
        glm::dvec3 direction{0, 0, 0};
        double low = 0;
        double high = 0;
    };
    glm::dvec3 origin{0, 0, 0};
    std::vector<glm::dvec3> points; ///< the hull's corners
    std::vector<Axis> axes;
    double margin = 0; ///< how far off the rasterizer's points may be
};

/// Size of the largest coordinate of a position, with which the margins of all beams grow. Takes
/// linear time, so compute it once for many beams.
double largest_position(const Scene& scene);

/// From the light to the picture's rectangle at view depth `depth`. `largest`: largest_position.
Beam beam_to_rectangle(const Scene& scene, double largest, double depth);

/// From the light to the pyramid between the eye and that rectangle; of an orthographic camera, to
/// the box between the near plane and the rectangle.
Beam beam_to_pyramid(const Scene& scene, double largest, double depth);

/// From the light to an axis-aligned box.
Beam beam_to_box(const Scene& scene, double largest, const glm::dvec3& low, const glm::dvec3& high);

/// Whether the convex hull of `points` and the beam may meet. Axes tried: the beam's own, and
/// `own` of the points; where none separates them, the answer is "may".
bool may_meet(const Beam& beam, std::span<const glm::dvec3> points,
              std::span<const glm::dvec3> own);

/// The same for a triangle, whose own axis is its normal.
bool may_meet(const Beam& beam, const TriangleCorners& corners);

/// The directions of the picture's rays: those on the inner side of its four side planes and of the
/// plane across `forward`. Of an orthographic camera, `forward` alone.
struct PictureCone {
    std::array<glm::dvec3, 5> inward; ///< normals of the planes
    double error = 0;                 ///< of the transform, for points of the scene
};
PictureCone picture_cone(const Scene& scene);

/// Where lines of sight come from: their directions reversed.
PictureCone opposite(PictureCone cone);

/// Whether some direction from `from` to a point of a triangle may be one of the cone's. From the
/// light: whether its volume may be seen at infinity.
bool may_point_into(const PictureCone& cone, const TriangleCorners& corners,
                    const glm::dvec3& from);

/// Whether a triangle may be in the picture, near and far plane aside.
bool may_be_in_picture(const Camera& camera, const PictureCone& cone,
                       const TriangleCorners& corners);

} // namespace shadowproof
