// A volume face in the picture: the pixels that a rasterizer must cover, those that it may cover,
// and the face's depth there.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "scenes/frame.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// Columns of pixels from `first` on, up to but not including `end`.
struct PixelRun {
    int first = 0;
    int end = 0;

    int length() const { return end > first ? end - first : 0; }
};

/// The smallest run that contains both; an empty one does not count.
PixelRun either(const PixelRun& one, const PixelRun& other);

/// A convex region of the picture, in pixels.
class ConvexRegion {
public:
    /// Points further inside the polygon than `margin` on both axes, or not distinguishable from
    /// such; if `margin` is negative, points no further outside. No points, no region.
    ConvexRegion(const std::vector<PicturePoint>& polygon, double margin);
    ConvexRegion() = default;
    /// The whole plane.
    static ConvexRegion everywhere();

    bool holds(const glm::dvec2& place) const;
    /// Pixels of row y whose centres it holds, in a picture of `width` columns.
    PixelRun row(int y, int width) const;
    /// Rows that may have such pixels, of `height` rows.
    PixelRun rows(int height) const;

private:
    /// A line that bounds it: x no more (or, for `lower`, no less) than at + slope y.
    struct Bound {
        double at = 0;
        double slope = 0;
        bool lower = false;
    };
    static constexpr std::size_t most_bounds = 16;
    std::array<Bound, most_bounds> bounds_{};
    std::size_t count_ = 0;
    glm::dvec2 low_{0, 0}; ///< no region: low_ beyond high_
    glm::dvec2 high_{-1, -1};

    void bound(const glm::dvec2& normal, double most);
};

/// Error of a face's nearness (nearness.h), at the pixels that a part of the face may cover.
struct DepthError {
    ConvexRegion part;
    double error = 0; ///< infinite where the part is seen edge-on
};

struct PicturedFace {
    ConvexRegion certain;
    ConvexRegion possible;
    /// Pixels with a certain fragment of exactly one of two faces: this one and the one that shares
    /// an edge with it. Without the latter, as `certain`. One of the two stands for both.
    ConvexRegion certain_of_both;
    bool is_one_of_two = false;  ///< there is such another face
    bool stands_for_both = true; ///< always, where there is none
    bool in_front = false;       ///< in front of everything
    bool edge_on = false;        ///< it may have any depth
    int change = 0; ///< +1: a ray enters the volume there, -1: it leaves it; 0: either may be drawn
    double margin = 0; ///< how far its corners may be drawn aside, in pixels; may be infinite
    std::uint32_t copies = 1; ///< how many faces it is (DrawnFace::copies)
    /// How often it may be drawn at a pixel: where the eye lies on its outline, clipping leaves a
    /// corner without a place, and the triangles of what is left may lie over each other.
    std::uint32_t times = 1;
    std::uint32_t light_cap_of = 0;  ///< the first of the triangles whose surface it coincides with
    std::uint32_t own_triangles = 0; ///< how many those are: one of each copy of a light cap
    /// How near it is (nearness.h) at a pixel (x, y): nearness . (x, y, 1).
    glm::dvec3 nearness{0, 0, 0};
    /// The parts in which it may be set up: more than one if it is clipped.
    std::vector<DepthError> parts;
};

/// How a picture is drawn.
struct PictureMaking {
    const Camera& camera;
    Drawing drawing;
    double half_step = 0; ///< of the snapping grid, in pixels
};

/// A triangle with homogeneous world points (p, w), as drawn by the transform that takes
/// `light_size`, the size of the light's coordinates, off a direction. `other`: the other corner of
/// a triangle that lies in the same plane, beyond the edge from the third corner to the first, and
/// is drawn with it; null where there is none.
/// `PicturedFace::change` is that of corners that run anticlockwise as seen from outside.
PicturedFace pictured_face(const PictureMaking& making, const std::array<glm::dvec4, 3>& corners,
                           const glm::dvec4* other, double light_size);

/// PicturedFace::margin of such a triangle as far as its size and place cause it: not where it is
/// that large because a corner at infinity lies in a direction of next to no length, as next to the
/// light.
double margin_by_size(const PictureMaking& making, const std::array<glm::dvec4, 3>& corners);

/// How layers in front of everything are drawn: they lie in the near plane, and are not clipped
/// there.
Drawing drawing_of_layers(Drawing drawing);

/// A layer in front of everything. `most`, `least`: what clipping leaves of it.
PicturedFace pictured_layer(const PictureMaking& making, const std::vector<ViewCorner>& most,
                            const std::vector<ViewCorner>& least);

} // namespace shadowproof
