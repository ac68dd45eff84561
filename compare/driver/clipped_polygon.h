// A triangle as a rasterizer's clipper leaves it, with bounds for float roundings. A corner made by
// clipping lies between two others; its error grows with the size of the larger one.
#pragma once

#include "scenes/depth_model.h"
#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <vector>

namespace shadowproof {

/// The parameters of a drawing that affect clipping.
struct Drawing {
    /// Depths of planes that clip. Where depths are clamped instead: the eye's, at which w is 0 or,
    /// where lines of sight are parallel, minus infinity; and infinity.
    double near = 0;
    double far = std::numeric_limits<double>::infinity();
    double offset = 0; ///< size of the eye's coordinates, where positions are transformed with them
    /// The projection's near plane where window depth rises with depth; 0 where it is reversed, or
    /// parallel.
    double standard_near = 0;
    /// Of a parallel projection: its planes, and the view depths that a window depth of 1 spans.
    double parallel_near = 0;
    double parallel_far = 0;
    double parallel_range = 0;
};

/// `far`: the far plane of what is drawn; infinite if none clips.
Drawing drawing_of(const Scene& scene, const DepthModel& model, double far);

/// A point of the picture, in pixels, and its depth's key, which is linear over the picture, as
/// window depth is: the inverse view depth or, where lines of sight are parallel, the view depth.
struct PicturePoint {
    glm::dvec2 place{0, 0};
    double key = 0;
    double inverse_w = 1;   ///< with which attributes are interpolated; also linear
    double place_error = 0; ///< of the float transform, as lateral_error has it, and of clipping
    double depth_error =
        0;              ///< of the key: of both and the window's roundings, as depth_error has it
    double w_error = 0; ///< of inverse_w
    bool made_by_clipping = false;
    /// Of the triangle's corners: what is linear over it has their values, so weighed, here.
    glm::dvec3 weights{0, 0, 0};
};

/// A corner relative to the eye, along right, up and forward, and w: exact, with bounds of its
/// error in floats.
struct ViewCorner {
    glm::dvec4 at{0, 0, 0, 0};
    glm::dvec3 error{0, 0, 0};  ///< of right, up and forward
    double w_error = 0;         ///< where clipping made a w that is neither 0 nor 1
    double numerator_error = 0; ///< of standard window depth's numerator, forward - 2 near w
    bool made_by_clipping = false;
    glm::dvec3 weights{0, 0, 0}; ///< as PicturePoint has them
};

/// A homogeneous world point (p, w) after the float transform.
ViewCorner viewed(const Camera& camera, const glm::dvec4& point, const Drawing& drawing);

/// By how much the floats of a corner may move the near plane's cut, or the far plane's, in view
/// depth (times w).
double near_error(const ViewCorner& corner, const Drawing& drawing);
double far_error(const ViewCorner& corner, const Drawing& drawing);

/// Where the near and far planes cut. The floats that decide on which side a corner lies have
/// errors, too.
enum class PlaneCut : std::uint8_t {
    nominal, ///< at their own depths
    most,    ///< so that they leave the most
    least,   ///< so that they leave the least
};

/// The part of a convex polygon where a function of its corners that is linear along edges is not
/// negative.
using ClipFunction = std::function<double(const ViewCorner&)>;
std::vector<ViewCorner> clipped(const std::vector<ViewCorner>& polygon,
                                const ClipFunction& function, const Drawing& drawing);

/// A convex polygon clipped as below.
std::vector<PicturePoint> clipped_polygon(const Camera& camera, std::vector<ViewCorner> polygon,
                                          const Drawing& drawing, PlaneCut cut);

/// `corners`: homogeneous world points (p, w). Clipped by the picture's right, left, upper and
/// lower border, and by the near and far plane, in this order, as llvmpipe does, which
/// sets none of the guard bands of Mesa's draw module (llvmpipe_create_context). What is left is
/// drawn as a fan from its first corner. Next to a border that just cuts off a corner one of its
/// triangles is thin, and its depths and slopes are off by much. Empty where nothing is left.
std::vector<PicturePoint> clipped_polygon(const Camera& camera,
                                          const std::array<glm::dvec4, 3>& corners,
                                          const Drawing& drawing);

/// Whether a polygon whose corners may each lie anywhere within their place_error, and all of it
/// `reach` pixels aside, may hold a place of the picture.
bool may_hold(const std::vector<PicturePoint>& polygon, const glm::dvec2& place, double reach);

/// Whether a convex polygon holds a place, and a disc of `reach` around it, wherever its corners
/// lie within their place_error.
bool certainly_holds(const std::vector<PicturePoint>& polygon, const glm::dvec2& place,
                     double reach);

/// The triangles that may draw a side of a volume, over the edge from corner `first` of a triangle
/// to the next. A side is two triangles; the order of positions decides which diagonal divides
/// them. `far_ends`: where the casters' positions lie once extruded, null where that is at
/// infinity.
std::array<std::array<glm::dvec4, 3>, 4> triangles_of_side(const Scene& casters,
                                                           const std::vector<glm::vec3>* far_ends,
                                                           std::uint32_t triangle, int first);

} // namespace shadowproof
