// The plane of a triangle at a pixel: the inverse view depth there, window depths made of it, and
// how far off a rasterizer may make them.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "scenes/depth_model.h"
#include "scenes/scene.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace shadowproof {

/// Window depth is `at_infinity` + `slope` times the inverse view depth.
struct WindowDepth {
    double at_infinity = 0;
    double slope = 0;

    double at(double inverse_depth) const { return at_infinity + slope * inverse_depth; }
};
WindowDepth window_depth_of(const DepthModel& model);

/// A triangle's plane: the inverse view depth along a ray of direction D is D . plane. Not finite
/// where the eye lies in it.
glm::dvec3 plane_before_eye(const Scene& scene, std::uint32_t triangle);

/// A picture whose depths are drawn: what all planes at all of its pixels share. Keeps a reference
/// to the scene.
struct DepthPicture {
    const Scene& scene;
    DepthModel model;
    Drawing drawing; ///< how its triangles are clipped
    double far = 0;  ///< the depth beyond which nothing is seen
    WindowDepth window;
    glm::dvec2 pixel{0, 0};  ///< its sides at depth 1
    double snapped_by = 0;   ///< half a step of the snapping grid, pixels
    double depth_rounds = 0; ///< the roundings of a window depth of 1, as inverse view depth
};

DepthPicture depth_picture(const Scene& scene, const DepthModel& model, const Drawing& drawing,
                           double far);

/// Keeps a reference to the picture.
class PlaneAtPixel {
public:
    PlaneAtPixel(const DepthPicture& picture, std::uint32_t triangle, int x, int y);
    /// `plane`: the triangle's, plane_before_eye's. `centre`: the direction of the pixel's centre.
    PlaneAtPixel(const DepthPicture& picture, std::uint32_t triangle, const glm::dvec3& plane,
                 const glm::dvec3& centre)
        : picture_(picture), triangle_(triangle), centre_(centre), plane_(plane),
          inverse_(glm::dot(centre_, plane_)) {}

    /// False if the eye lies in the plane: the triangle has no area in the picture, and any depth
    /// may come out.
    bool has_depth() const {
        return std::isfinite(inverse_) && std::isfinite(plane_.x + plane_.y + plane_.z);
    }
    double inverse_depth() const { return inverse_; }
    /// Of the pixel's centre.
    const glm::dvec3& direction() const { return centre_; }

    /// A quick lower bound of error(), which nearly always suffices: half a step of the snapping
    /// grid and the roundings of a depth.
    double least_error(double window_depth) const;
    /// Of the inverse depth, where the triangle is drawn aside: moving the pixel's centre changes
    /// it by the slope.
    double error_of_place() const { return lateral() * slope(); }
    /// The same, plus the errors of set-up and of window depth's roundings. depth_error is for two
    /// depths that are compared; this is one depth.
    double error() const;
    /// Largest error of a direction's component at the picture's corners.
    double spread() const;
    /// How far aside the triangle may be drawn, in pixels.
    double lateral() const;

    /// Whether a window depth that was read back may be the plane's.
    bool is_depth(double read) const;

private:
    const DepthPicture& picture_;
    std::uint32_t triangle_;
    glm::dvec3 centre_;
    glm::dvec3 plane_;
    double inverse_;

    double slope() const; ///< change of the inverse depth, the largest over a pixel's step
};

} // namespace shadowproof
