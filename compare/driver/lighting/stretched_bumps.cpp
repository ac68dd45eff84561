#include "compare/driver/lighting/stretched_bumps.h"

#include "compare/driver/lighting/lighting_tables.h"
#include "scenes/driver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

Intervals cross(const Intervals& a, const Intervals& b) {
    return {a[1] * b[2] + -1 * (a[2] * b[1]), a[2] * b[0] + -1 * (a[0] * b[2]),
            a[0] * b[1] + -1 * (a[1] * b[0])};
}

Intervals times(const Interval& by, const Intervals& a) {
    return {by * a[0], by * a[1], by * a[2]};
}

double largest(const Interval& a) {
    return std::max(std::abs(a.low), std::abs(a.high));
}

} // namespace

// Floats: a side is rounded (v a component), and turned into the axes of lighting by a rounded
// matrix: of each component its entries (v), three products (v) and two sums (2 v), the root of 3
// of which is 7 v of the length. Of a cross product with N three roundings, times a slope one,
// their sum one: 5 v of each slope times the other side. Of the area 6 v of both sides' product;
// the quotient v, of at most as much as comes out. G lies across the normal that is drawn: along
// this one it has as much as both differ by.
VectorRange normal_over_texel_sides(const Scene& scene, std::uint32_t triangle,
                                    const TangentFrame& frame, double side,
                                    const RangeOf<glm::dvec2>& slope) {
    const ExpectedTexelSides sides = expected_texel_sides(scene, triangle);
    const double along_length = glm::length(sides.along);
    const double down_length = glm::length(sides.down);
    const double rounding = frame.normal_off > 0 ? v : 0;
    const Intervals normal = around(frame.normal, frame.normal_off);
    const Intervals along = around(sides.along, 8 * rounding * along_length);
    const Intervals down = around(sides.down, 8 * rounding * down_length);
    const Interval area =
        widened(dot(normal, cross(along, down)), 6 * rounding * along_length * down_length);
    if (area.low == 0 && area.high == 0) return {around(glm::dvec3(0, 0, 1)), frame.normal_off};
    if (area.contains(0)) return {around(glm::dvec3(0, 0, 1)), 0, 2};
    const Interval share{1 / area.high, 1 / area.low};
    const Intervals lifted =
        times(slope[0], cross(down, normal)) + times(slope[1], cross(normal, along));
    const Intervals gradient = times(
        share,
        widened(lifted, 5 * rounding *
                            (largest(slope[0]) * down_length + largest(slope[1]) * along_length)));
    const double quotient = rounding * longest(gradient);
    // G is the same for N and -N, and leans the front's normal; the frame is that of the seen side.
    const auto component = [&](const glm::dvec3& axis) {
        return widened(-side * dot(gradient, around(axis)), quotient);
    };
    return {{component(frame.tangent), component(frame.bitangent), around(1)},
            frame.normal_off * (1 + longest(gradient))};
}

} // namespace shadowproof
