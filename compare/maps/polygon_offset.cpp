#include "compare/maps/polygon_offset.h"

#include "scenes/roundoff.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// The size of a product of differences less another, and by how much it may be off.
struct Determinant {
    double size = 0;
    double error = 0;

    double least() const { return std::max(size - error, 0.0); }
    double most() const { return size + error; }
};

/// a d - b c, each of whose factors is off by an error of its own. Differences, products and their
/// difference round by v of their sizes, and what is divided and multiplied after it once more
/// each: 6 v of both terms.
Determinant determinant(double a, double b, double c, double d, double error_of_ab,
                        double error_of_cd) {
    const double terms = std::abs(a * d) + std::abs(b * c);
    return {std::abs(a * d - b * c), error_of_ab * (std::abs(c) + std::abs(d)) +
                                         error_of_cd * (std::abs(a) + std::abs(b)) +
                                         2 * error_of_ab * error_of_cd + 6 * v * terms};
}

/// The factor times a triangle's slope. OpenGL 4.5, section 14.6.5: that is the length of the
/// gradient, or the larger of its components instead.
PolygonOffset offset_of_slope(const PicturePoint& a, const PicturePoint& b, const PicturePoint& c,
                              double times, double reach) {
    const double moved = 2 * (reach + std::max({a.place_error, b.place_error, c.place_error}));
    const double deeper = 2 * std::max({a.depth_error, b.depth_error, c.depth_error});
    const glm::dvec2 d01 = a.place - b.place;
    const glm::dvec2 d20 = c.place - a.place;
    const double z01 = a.key - b.key;
    const double z20 = c.key - a.key;
    const Determinant area = determinant(d01.x, d01.y, d20.x, d20.y, moved, moved);
    const Determinant x = determinant(z01, d01.y, z20, d20.y, 0, 0);
    const Determinant y = determinant(z01, d01.x, z20, d20.x, 0, 0);
    const auto off = [&](double one, double other) {
        return deeper * (std::abs(one) + std::abs(other) + 2 * moved) +
               moved * (std::abs(z01) + std::abs(z20));
    };
    const Determinant along_x{x.size, x.error + off(d01.y, d20.y)};
    const Determinant along_y{y.size, y.error + off(d01.x, d20.x)};
    const double least = std::max(along_x.least(), along_y.least()) / area.most();
    const double most = area.least() > 0 ? std::hypot(along_x.most(), along_y.most()) / area.least()
                                         : std::numeric_limits<double>::infinity();
    return {times * std::max(x.size, y.size) / area.size, times * least * (1 - 4 * v),
            times * most * (1 + 4 * v)};
}

double twice_area(const PicturePoint& a, const PicturePoint& b, const PicturePoint& c) {
    const glm::dvec2 ab = b.place - a.place;
    const glm::dvec2 ac = c.place - a.place;
    return std::abs(ab.x * ac.y - ab.y * ac.x);
}

/// Of a polygon that is drawn as several triangles, each may have its own. That of the exact plane
/// is the largest triangle's, which double computes best.
PolygonOffset offset_of_slope(const std::vector<PicturePoint>& polygon, const glm::dvec2& place,
                              double times, double reach) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    PolygonOffset here{0, infinity, 0};
    PolygonOffset any{0, infinity, 0};
    double largest = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const std::vector<PicturePoint> triangle{polygon[0], polygon[i - 1], polygon[i]};
        const PolygonOffset each =
            offset_of_slope(triangle[0], triangle[1], triangle[2], times, reach);
        const double area = twice_area(triangle[0], triangle[1], triangle[2]);
        if (area > largest) {
            largest = area;
            any.own = each.own;
        }
        const bool holds = may_hold(triangle, place, std::numbers::sqrt2 * reach);
        for (PolygonOffset* offset : {&here, &any}) {
            if (offset == &here && !holds) continue;
            offset->least = std::min(offset->least, each.least);
            offset->most = std::max(offset->most, each.most);
        }
    }
    const PolygonOffset& found = here.least < infinity ? here : any;
    return {any.own, found.least, found.most};
}

/// What floats resolve next to a depth from 0 to 1: 2^(e - 23), where e is its exponent.
double float_step(double depth) {
    return std::exp2(std::ilogb(std::clamp(depth, double{FLT_MIN}, 1.0)) - 23);
}

/// OpenGL 4.5, section 14.6.5: one unit is the smallest difference of window depths that the format
/// resolves. Of fixed point it is a constant of the driver's. Of floats it depends on the
/// triangle's largest depth; each of the triangles that a polygon is drawn as has three of its
/// corners, so that the third smallest is the least that counts.
PolygonOffset resolved(const std::vector<PicturePoint>& polygon, const MapModel& model,
                       const OffsetUnit& unit, const WindowDepth& window) {
    if (!depth_format_of(model.format).floating)
        return {0.5 * (unit.least + unit.most), unit.least, unit.most};
    std::vector<double> depths;
    double error = 0;
    for (const PicturePoint& point : polygon) {
        depths.push_back(window.at_zero + window.slope * point.key);
        error = std::max(error, std::abs(window.slope) * point.depth_error);
    }
    std::ranges::sort(depths);
    return {float_step(depths.back()), float_step(depths[2] - error),
            float_step(depths.back() + error)};
}

} // namespace

PolygonOffset polygon_offset(const std::vector<PicturePoint>& polygon, const glm::dvec2& place,
                             const MapModel& model, const OffsetUnit& unit,
                             const WindowDepth& window, double reach) {
    if (!model.has_offset() || polygon.size() < 3) return {};
    PolygonOffset offset;
    if (model.slope_bias != 0)
        offset = offset_of_slope(polygon, place, model.slope_bias * std::abs(window.slope), reach);
    if (model.offset_units == 0) return offset;
    const PolygonOffset one = resolved(polygon, model, unit, window);
    return {offset.own + model.offset_units * one.own,
            offset.least + model.offset_units * one.least * (1 - 2 * v),
            offset.most + model.offset_units * one.most * (1 + 2 * v)};
}

} // namespace shadowproof
