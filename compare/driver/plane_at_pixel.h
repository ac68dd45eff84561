// The plane of a triangle at a pixel: its depth's key there, window depths made of it, and how far
// off a rasterizer may make them. The key is what window depth is linear in: the inverse view depth
// or, where lines of sight are parallel, the view depth.
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

/// Window depth is `at_zero` + `slope` times the key.
struct WindowDepth {
    double at_zero = 0;
    double slope = 0;

    double at(double key) const { return at_zero + slope * key; }
};
WindowDepth window_depth_of(const DepthModel& model);

/// A triangle's plane as the eye sees it: its key along a line of sight is line . gradient +
/// at_zero. Not finite where the eye, or the direction to it, lies in the plane.
struct SeenPlane {
    glm::dvec3 gradient{0, 0, 0};
    double at_zero = 0; ///< 0 in perspective

    double at(const glm::dvec3& line) const { return glm::dot(line, gradient) + at_zero; }
};
SeenPlane plane_before_eye(const Scene& scene, std::uint32_t triangle);

/// A picture whose depths are drawn: what all planes at all of its pixels share. Keeps a reference
/// to the scene.
struct DepthPicture {
    const Scene& scene;
    DepthModel model;
    Drawing drawing; ///< how its triangles are clipped
    double far = 0;  ///< the depth beyond which nothing is seen
    WindowDepth window;
    glm::dvec2 pixel{0, 0};  ///< its sides, as half_extent has them
    double snapped_by = 0;   ///< half a step of the snapping grid, pixels
    double depth_rounds = 0; ///< the roundings of a window depth of 1, as key
};

DepthPicture depth_picture(const Scene& scene, const DepthModel& model, const Drawing& drawing,
                           double far);

/// Keeps a reference to the picture.
class PlaneAtPixel {
public:
    PlaneAtPixel(const DepthPicture& picture, std::uint32_t triangle, int x, int y);
    /// `plane`: the triangle's, plane_before_eye's. `centre`: the line of sight of the pixel's
    /// centre.
    PlaneAtPixel(const DepthPicture& picture, std::uint32_t triangle, const SeenPlane& plane,
                 const glm::dvec3& centre)
        : picture_(picture), triangle_(triangle), centre_(centre), plane_(plane),
          key_(plane.at(centre)) {}

    /// False if the plane is seen edge-on: the triangle has no area in the picture, and any depth
    /// may come out.
    bool has_depth() const {
        const glm::dvec3& gradient = plane_.gradient;
        return std::isfinite(key_) && std::isfinite(gradient.x + gradient.y + gradient.z);
    }
    double key() const { return key_; }
    /// View depth, at most the picture's far one; where lines of sight are parallel, not before the
    /// near plane.
    double depth() const;
    /// Of the pixel's centre.
    const glm::dvec3& line() const { return centre_; }

    /// A quick lower bound of error(), which nearly always suffices: half a step of the snapping
    /// grid and the roundings of a depth.
    double least_error(double window_depth) const;
    /// Of the key, where the triangle is drawn aside: moving the pixel's centre changes it by the
    /// slope.
    double error_of_place() const { return lateral() * slope(); }
    /// The same, plus the errors of set-up and of window depth's roundings. depth_error is for two
    /// depths that are compared; this is one depth.
    double error() const;
    /// Largest error of a line of sight's component at the picture's corners.
    double spread() const;
    /// How far aside the triangle may be drawn, in pixels.
    double lateral() const;

    /// Whether a window depth that was read back may be the plane's.
    bool is_depth(double read) const;

private:
    const DepthPicture& picture_;
    std::uint32_t triangle_;
    glm::dvec3 centre_;
    SeenPlane plane_;
    double key_;

    double slope() const; ///< change of the key, the largest over a pixel's step
};

} // namespace shadowproof
