#include "compare/driver/clipped_polygon.h"

#include "scenes/driver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

using Corner = ViewCorner;
using Polygon = std::vector<Corner>;

// Mesa's draw module makes a corner as out + t (in - out), in each component of the clip
// coordinates: the difference, its product and the sum round, by v of at most the larger corner's
// size each, as t is between 0 and 1. An error of t itself moves the corner along the edge. The
// corners' own errors weigh as they do.
Corner between(const Corner& from, const Corner& to, double t, const Drawing& drawing) {
    const double near = drawing.standard_near;
    const auto numerator = [&](const Corner& corner) {
        return near > 0 ? std::abs(corner.at.z - 2 * near * corner.at.w) : 0.0;
    };
    Corner made;
    made.at = from.at + t * (to.at - from.at);
    const glm::dvec3 larger = glm::max(glm::abs(glm::dvec3(from.at)), glm::abs(glm::dvec3(to.at)));
    made.error = (1 - t) * from.error + t * to.error + 3 * v * larger;
    made.error.z += 3 * v * drawing.parallel_far * std::max(from.at.w, to.at.w); // z's constant
    if (from.at.w != to.at.w)
        made.w_error =
            (1 - t) * from.w_error + t * to.w_error + 3 * v * std::max(from.at.w, to.at.w);
    made.numerator_error = (1 - t) * from.numerator_error + t * to.numerator_error +
                           3 * v * std::max(numerator(from), numerator(to));
    made.made_by_clipping = true;
    made.weights = from.weights + t * (to.weights - from.weights);
    return made;
}

// Reversed window depth is the near plane over the depth, and as far off as that. Standard depth is
// half the quotient of numerator and depth, and the inverse depth is what is left of it to 1, over
// the near plane: both are rounded, each by itself, so that what moves a point along its ray in
// reversed depth moves it by depth / near as much here. Parallel depth is a multiple of the
// numerator, and w is 1 but where clipping cuts what reaches to infinity; of what is clamped,
// window depth is larger than 1, and rounds by as much more. Where floats may put the corner into
// the eye or behind it, as only those of faces that pass the eye that closely, or to infinity, it
// may be anywhere in the picture.
PicturePoint pictured(const Camera& camera, const Corner& corner, const Drawing& drawing) {
    const glm::dvec2 half = half_extent(camera);
    const glm::dvec4& at = corner.at;
    const double divisor = camera.is_orthographic() ? at.w : at.z; // w of the clip coordinates
    PicturePoint point{.place = {(at.x / divisor / half.x + 1) * 0.5 * camera.width,
                                 (1 - at.y / divisor / half.y) * 0.5 * camera.height},
                       .key = (camera.is_orthographic() ? at.z : at.w) / divisor,
                       .inverse_w = (camera.is_orthographic() ? 1 : at.w) / divisor,
                       .made_by_clipping = corner.made_by_clipping,
                       .weights = corner.weights};
    const double pixels = std::max({std::abs(point.place.x), std::abs(point.place.y),
                                    double(camera.width), double(camera.height)});
    const double scale = 0.5 * camera.height / camera.half_height;
    const double standard_near = drawing.standard_near;
    if (camera.is_orthographic()) {
        const double w_error = corner.w_error / at.w;
        const double spanned =
            std::max({drawing.parallel_range, std::abs(point.key - drawing.parallel_near),
                      std::abs(point.key - drawing.parallel_far)});
        point.place_error = std::max(corner.error.x, corner.error.y) / at.w * scale +
                            w_error * pixels + 3 * v * pixels;
        point.w_error = (w_error + v) * point.inverse_w;
        point.depth_error = near_error(corner, drawing) / at.w + w_error * std::abs(point.key) +
                            window_depth_roundings * v * spanned;
        if (!(at.w > corner.w_error)) point.place_error = std::numeric_limits<double>::infinity();
        return point;
    }
    const double depth_error = corner.error.z / at.z;
    point.place_error = std::max(corner.error.x, corner.error.y) / at.z * scale +
                        depth_error * pixels + 3 * v * pixels;
    const double transform =
        standard_near > 0 ? 0.5 * (corner.numerator_error + corner.error.z) / at.z / standard_near
                          : depth_error * point.key;
    point.w_error = (depth_error + v) * point.inverse_w;
    point.depth_error = transform + window_depth_roundings * v * point.key;
    if (!(at.z > corner.error.z)) point.place_error = std::numeric_limits<double>::infinity();
    return point;
}

} // namespace

// A corner is kept where the clip coordinates say so. Window depth's numerator z and w are off by 5
// v of their terms each, which are those of forward and, but in reversed depth, twice the near
// plane: their sum or difference moves the near plane by no more than forward's own error and 6 v
// of the plane's depth. The far plane is where z and w are equal: where standard depth is, they are
// so nearly alike everywhere that the same error moves it by (far - near) / near as much. Parallel
// depth's numerator has a constant term, as depth up to the far plane's, which is rounded as it is
// made and in the sums: 6 v of it are more than all, and both planes are as far off.
double near_error(const Corner& corner, const Drawing& drawing) {
    if (drawing.parallel_range > 0)
        return corner.error.z + 6 * v * drawing.parallel_far * corner.at.w;
    return corner.error.z + 6 * v * drawing.near * corner.at.w;
}
double far_error(const Corner& corner, const Drawing& drawing) {
    if (drawing.parallel_range > 0) return near_error(corner, drawing);
    const double n = drawing.standard_near;
    if (n > 0)
        return (corner.error.z + 6 * v * n * corner.at.w) * std::max((drawing.far - n) / n, 1.0);
    return corner.error.z + 6 * v * drawing.far * corner.at.w;
}

// A row of the transform holds a direction of the camera, and the eye's place along it as the last
// term. What is relative to the eye, or to the light, is rounded twice before, so that 5 roundings
// of double its size are more than all.
ViewCorner viewed(const Camera& camera, const glm::dvec4& point, const Drawing& drawing) {
    const glm::dvec3 relative = glm::dvec3(point) - point.w * camera.eye;
    const bool from_origin = drawing.offset > 0 && point.w > 0;
    ViewCorner corner;
    corner.at.w = point.w;
    const std::array<glm::dvec3, 3> axes{camera.right, camera.up, camera.forward};
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3& axis = axes[static_cast<std::size_t>(k)];
        corner.at[k] = glm::dot(axis, relative);
        const double terms = from_origin ? glm::dot(glm::abs(axis), glm::abs(glm::dvec3(point))) +
                                               point.w * std::abs(glm::dot(axis, camera.eye))
                                         : 2 * glm::dot(glm::abs(axis), glm::abs(relative));
        corner.error[k] = transform_roundings * v * terms;
    }
    if (drawing.standard_near > 0)
        corner.numerator_error =
            corner.error.z + transform_roundings * v * 2 * drawing.standard_near * point.w;
    return corner;
}

std::vector<ViewCorner> clipped(const std::vector<ViewCorner>& polygon,
                                const ClipFunction& function, const Drawing& drawing) {
    Polygon kept; // Sutherland & Hodgman 1974
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& from = polygon[i];
        const Corner& to = polygon[(i + 1) % polygon.size()];
        const double one = function(from);
        const double other = function(to);
        if (one >= 0) kept.push_back(from);
        if ((one < 0) != (other < 0))
            kept.push_back(between(from, to, one / (one - other), drawing));
    }
    return kept;
}

std::vector<PicturePoint> clipped_polygon(const Camera& camera, std::vector<ViewCorner> polygon,
                                          const Drawing& drawing, PlaneCut cut) {
    const glm::dvec2 half = half_extent(camera);
    const double sign = cut == PlaneCut::nominal ? 0 : (cut == PlaneCut::most ? 1 : -1);
    const auto clip = [&](const ClipFunction& function) {
        const bool all_kept =
            std::all_of(polygon.begin(), polygon.end(),
                        [&](const Corner& corner) { return function(corner) >= 0; });
        if (!all_kept) polygon = clipped(polygon, function, drawing);
    };
    for (const int axis : {0, 1})
        for (const double side : {-1.0, 1.0})
            clip([&](const Corner& c) {
                const double w = camera.is_orthographic() ? c.at.w : c.at.z;
                const double w_error = camera.is_orthographic() ? c.w_error : c.error.z;
                return side * c.at[axis] + half[axis] * w +
                       sign * (c.error[axis] + half[axis] * w_error);
            });
    if (std::isfinite(drawing.near))
        clip([&](const Corner& c) {
            return c.at.z - drawing.near * c.at.w + sign * near_error(c, drawing);
        });
    if (std::isfinite(drawing.far))
        clip([&](const Corner& c) {
            return drawing.far * c.at.w - c.at.z + sign * far_error(c, drawing);
        });
    std::vector<PicturePoint> points;
    for (const Corner& corner : polygon) points.push_back(pictured(camera, corner, drawing));
    return points;
}

Drawing drawing_of(const Scene& scene, const DepthModel& model, double far) {
    const double clamped = model.parallel ? -std::numeric_limits<double>::infinity() : 0;
    return {.near = model.clamp ? clamped : scene.camera.near,
            .far = far,
            .offset = model.eye_relative ? 0 : glm::length(scene.camera.eye),
            .standard_near = model.reversed() || scene.camera.is_orthographic() ? 0 : model.near,
            .parallel_near = model.parallel ? model.near : 0,
            .parallel_far = model.parallel ? model.far : 0,
            .parallel_range = model.parallel ? (model.far - model.near) / (1 - model.front) : 0};
}

std::vector<PicturePoint> clipped_polygon(const Camera& camera,
                                          const std::array<glm::dvec4, 3>& corners,
                                          const Drawing& drawing) {
    Polygon polygon;
    for (int k = 0; k < 3; ++k) {
        polygon.push_back(viewed(camera, corners[static_cast<std::size_t>(k)], drawing));
        polygon.back().weights[k] = 1;
    }
    return clipped_polygon(camera, std::move(polygon), drawing, PlaneCut::nominal);
}

// The corners are discs, and the polygon lies within the discs' convex hull. A place outside of it
// is separated from it by the line across the way to the hull's nearest point, which lies on a disc
// or on a line that touches two of them.
bool may_hold(const std::vector<PicturePoint>& polygon, const glm::dvec2& place, double reach) {
    const auto is_beyond = [&](const glm::dvec2& direction) {
        return std::all_of(polygon.begin(), polygon.end(), [&](const PicturePoint& corner) {
            return glm::dot(direction, place - corner.place) > corner.place_error + reach;
        });
    };
    for (const PicturePoint& one : polygon) {
        const glm::dvec2 way = place - one.place;
        if (way != glm::dvec2(0) && is_beyond(glm::normalize(way))) return false;
        for (const PicturePoint& other : polygon) {
            const glm::dvec2 along = other.place - one.place;
            const double length = glm::length(along);
            const double growth = one.place_error - other.place_error;
            if (!(length > std::abs(growth))) continue; // one disc holds the other
            const double sine = growth / length;
            const double cosine = std::sqrt(1 - sine * sine);
            const glm::dvec2 unit = along / length;
            const glm::dvec2 across(-unit.y, unit.x);
            if (is_beyond(sine * unit + cosine * across)) return false;
        }
    }
    return !polygon.empty();
}

// Along the line of an edge, at t from its first corner (0) to its second (1), corners that are off
// by r and s move the line by |1 - t| r + |t| s at most.
bool certainly_holds(const std::vector<PicturePoint>& polygon, const glm::dvec2& place,
                     double reach) {
    if (polygon.size() < 3) return false;
    int turn = 0; // which way round the corners run
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PicturePoint& from = polygon[i];
        const PicturePoint& to = polygon[(i + 1) % polygon.size()];
        const glm::dvec2 along = to.place - from.place;
        const double length = glm::length(along);
        const glm::dvec2 way = place - from.place;
        const double t = glm::dot(way, along) / (length * length);
        const double moved = std::abs(1 - t) * from.place_error + std::abs(t) * to.place_error;
        const double distance = (along.x * way.y - along.y * way.x) / length;
        if (!(std::abs(distance) > moved + reach)) return false; // nor where it is no number
        const int side = distance > 0 ? 1 : -1;
        if (turn == -side) return false;
        turn = side;
    }
    return true;
}

std::array<std::array<glm::dvec4, 3>, 4> triangles_of_side(const Scene& casters,
                                                           const std::vector<glm::vec3>* far_ends,
                                                           std::uint32_t triangle, int first) {
    const glm::dvec4 light = homogeneous(chosen_light(casters));
    const auto start = [&](int k) {
        return glm::dvec4(glm::dvec3(casters.positions[casters.triangles[triangle][k]]), 1);
    };
    const auto end = [&](int k) {
        if (far_ends == nullptr) return light.w * start(k) - light;
        return glm::dvec4(glm::dvec3((*far_ends)[casters.triangles[triangle][k]]), 1);
    };
    const int a = first;
    const int b = (first + 1) % 3;
    return {{{start(a), start(b), end(b)},
             {start(a), end(b), end(a)},
             {start(b), start(a), end(a)},
             {start(b), end(a), end(b)}}};
}

} // namespace shadowproof
