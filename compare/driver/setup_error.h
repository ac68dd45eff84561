// Error bounds of triangle set-up: of the plane of a face's depths over the picture, and of other
// interpolated values. The error is large for long and thin triangles, such as the volume sides of
// fine meshes: rounding their slopes tilts the plane far more than that of a well-shaped triangle.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "reference/predict/ledger.h"
#include "scenes/scene.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

/// A pixel that a face covers.
struct CoveredPixel {
    glm::dvec3 line{0, 0, 0}; ///< of sight, of its centre
    double reach = 0;         ///< pixels by which a face may be drawn aside
    Drawing drawing;
};

/// Error of a triangle's key (PicturePoint) at a pixel. Infinite where the triangle is seen
/// edge-on, as then any slope may come out.
double setup_error(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel);

/// The same for a face of a volume. `far_ends`: where the casters' positions lie once extruded,
/// null where that is at infinity; a cap there has no depth, so none that may be off.
double setup_error(const Scene& casters, const std::vector<glm::vec3>* far_ends,
                   const Crossing& face, const CoveredPixel& pixel);

/// The same of the inverse of w that a triangle's fragment has at a pixel, in perspective.
double inverse_w_error(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel);

/// The same for a triangle of the picture, whose `key` may be any value that is linear over it, at
/// a place that it may cover when it is drawn `reach` pixels aside.
double setup_error(const std::array<PicturePoint, 3>& triangle, const glm::dvec2& place,
                   double reach);

/// Whether a triangle may cover the pixel flipped, so that its other side is seen: its corners'
/// errors, and snapping by up to the pixel's reach along each axis, may reverse their winding.
bool may_be_flipped(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel);

/// Whether the same may reverse the winding of a triangle of the picture.
bool may_be_flipped(const std::array<PicturePoint, 3>& triangle, double reach);

/// The triangles that are set up of one with homogeneous world points (p, w): a fan over what
/// clipping leaves.
std::vector<std::array<PicturePoint, 3>>
set_up(const Camera& camera, const std::array<glm::dvec4, 3>& corners, const Drawing& drawing);

/// The same triangles with the inverse of w, and its error, for key.
std::vector<std::array<PicturePoint, 3>>
with_inverse_w(std::vector<std::array<PicturePoint, 3>> triangles);

/// Those of what clipping has left.
std::vector<std::array<PicturePoint, 3>> fan_of(const std::vector<PicturePoint>& polygon);

/// Whether a triangle of the picture comes within `reach` pixels of a place.
bool may_reach(const std::array<PicturePoint, 3>& triangle, const glm::dvec2& pixel, double reach);

/// Whether set-up, whose floats are not snapped, may find no area in a triangle whose corners lie
/// where they should. Then 1 / A is infinite, and the depth no number or any: also where that of
/// all corners is the same, as 0 / 0 is none.
bool may_have_no_area(const std::array<PicturePoint, 3>& triangle);

/// The largest error for a triangle of the picture, over all pixels within `reach` of it.
double largest_setup_error(const std::array<PicturePoint, 3>& triangle, double reach);

/// Error of a value interpolated over a triangle, in perspective, at a pixel: as a share of the
/// value's size at the corner where it is largest. `variation`: the largest difference between
/// corners, as a share of the same. Infinite where the triangle is seen edge-on, and where exact
/// clipping leaves nothing of it.
double attribute_error(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel,
                       double variation = 2);

/// A value interpolated over a triangle, in perspective, at a pixel.
struct DrawnAttribute {
    double share = 0; ///< its error, as attribute_error has it, without the part in `aside`
    /// Pixels, along each axis, by which the place that it is the value of may lie beside those
    /// within the pixel's reach: corners that clipping makes are rounded, and are drawn aside.
    double aside = 0;
};

/// Both, of a value that differs between corners by up to twice its largest size. Both are infinite
/// where either is.
DrawnAttribute drawn_attribute(const Scene& scene, std::uint32_t triangle,
                               const CoveredPixel& pixel);

/// Error, in each component, of a point's place relative to `origin`, interpolated like that.
double interpolated_place_error(const Scene& scene, std::uint32_t triangle,
                                const CoveredPixel& pixel, const glm::dvec3& origin);

} // namespace shadowproof
