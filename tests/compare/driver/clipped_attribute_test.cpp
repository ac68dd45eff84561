// Values interpolated over triangles that the picture's borders cut, in a rasterizer's own floats:
// clipping, set-up and interpolation. They are those of places that drawn_attribute tells of.
#include "compare/driver/error_bounds.h"
#include "compare/driver/interval.h"
#include "compare/driver/setup_error.h"
#include "reference/trace/faces.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace shadowproof {
namespace {

constexpr int side = 64; // pixels

/// A triangle before a camera, and a value at each of its corners.
struct Drawn {
    Scene scene;
    glm::dvec3 values{0, 0, 0};
};

/// A floor or a wall that reaches beyond the picture to all sides but that of its horizon; of some,
/// a corner lies a hair beside the border, which cuts it off.
Drawn large_triangle(Dice& dice) {
    Drawn drawn;
    Camera& camera = drawn.scene.camera;
    camera.half_height = 0.5;
    camera.width = camera.height = side;
    const double far = std::pow(10, dice.between(0.5, 4));
    const double turn = dice.between(0, 3);
    const glm::dvec3 right(std::cos(turn), std::sin(turn), 0);
    const glm::dvec3 below(std::sin(turn), -std::cos(turn), 0);
    const auto add = [&](double along, double depth) {
        const double aside = dice.between(0.9, 1.1) * far * along;
        const double down = dice.between(1, 2);
        drawn.scene.positions.emplace_back(aside * right + down * below + glm::dvec3(0, 0, -depth));
    };
    add(-1, dice.between(0.2, 2));
    add(1, dice.between(0.2, 2));
    add(dice.between(-1, 1), far);
    if (dice.one_in(3)) {
        const double hair = std::pow(10, dice.between(-7, -1));
        drawn.scene.positions[2] = glm::vec3(
            line_of_sight(camera, side + hair, dice.between(0, side)) * dice.between(2, 20));
    }
    drawn.scene.triangles = {{0, 1, 2}};
    drawn.scene.lights.emplace_back();
    for (int k = 0; k < 3; ++k) drawn.values[k] = static_cast<float>(dice.between(-1, 1));
    return drawn;
}

/// Where the ray meets the triangle's plane: by a linear equation.
double value_along(const Drawn& drawn, const glm::dvec3& direction) {
    const Scene& scene = drawn.scene;
    glm::dvec3 weights =
        glm::inverse(glm::dmat3(corner(scene, 0, 0), corner(scene, 0, 1), corner(scene, 0, 2))) *
        direction;
    return glm::dot(weights, drawn.values) / (weights.x + weights.y + weights.z);
}

struct FloatCorner {
    glm::vec4 clip{0, 0, 0, 0}; ///< x, y, w, and the value
};

/// The polygon that is left where `distance`, of the border, is not negative.
template <class Distance>
std::vector<FloatCorner> cut(const std::vector<FloatCorner>& polygon, const Distance& distance) {
    std::vector<FloatCorner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const FloatCorner& from = polygon[i];
        const FloatCorner& to = polygon[(i + 1) % polygon.size()];
        const float one = distance(from.clip);
        const float other = distance(to.clip);
        if (one >= 0) kept.push_back(from);
        if ((one < 0) == (other < 0)) continue;
        const float t = one / (one - other);
        kept.push_back({from.clip + t * (to.clip - from.clip)});
    }
    return kept;
}

/// Whether corners that are snapped to a 256th of a pixel cover a place.
bool covers(const std::array<glm::vec2, 3>& at, const glm::vec2& place) {
    std::array<glm::dvec2, 3> snapped{};
    for (std::size_t k = 0; k < 3; ++k) snapped[k] = glm::round(256.0 * glm::dvec2(at[k])) / 256.0;
    const auto twice_area = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const double area = twice_area(snapped[0], snapped[1], snapped[2]);
    if (area == 0) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (twice_area(snapped[k], snapped[(k + 1) % 3], glm::dvec2(place)) * area < 0)
            return false;
    return true;
}

/// What is interpolated at a place by planes over the first corner, which is not snapped, all in
/// floats; none where the triangle does not cover it.
std::optional<double> interpolated(const std::array<FloatCorner, 3>& corners,
                                   const glm::vec2& place) {
    std::array<glm::vec2, 3> at{};
    glm::vec3 inverse(0);
    glm::vec3 over(0);
    for (int k = 0; k < 3; ++k) {
        const glm::vec4& clip = corners[static_cast<std::size_t>(k)].clip;
        inverse[k] = 1 / clip.z;
        at[static_cast<std::size_t>(k)] = {clip.x * inverse[k] * (side / 2.F) + side / 2.F,
                                           -clip.y * inverse[k] * (side / 2.F) + side / 2.F};
        over[k] = clip.w * inverse[k];
    }
    if (!covers(at, place)) return std::nullopt;
    const glm::vec2 d01 = at[0] - at[1];
    const glm::vec2 d20 = at[2] - at[0];
    const float area = d01.x * d20.y - d20.x * d01.y;
    const auto plane = [&](const glm::vec3& values) {
        const float z01 = values[0] - values[1];
        const float z20 = values[2] - values[0];
        const float along = z01 * (d20.y / area) - z20 * (d01.y / area);
        const float down = z20 * (d01.x / area) - z01 * (d20.x / area);
        const float origin = values[0] - (along * at[0].x + down * at[0].y);
        return origin + along * place.x + down * place.y;
    };
    return double{plane(over) / plane(inverse)};
}

std::optional<double> rasterized(const Drawn& drawn, const glm::vec2& place) {
    const float half = static_cast<float>(drawn.scene.camera.half_height);
    std::vector<FloatCorner> polygon;
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 at(corner(drawn.scene, 0, k));
        polygon.push_back({{at.x / half, at.y / half, -at.z, static_cast<float>(drawn.values[k])}});
    }
    polygon = cut(polygon, [](const glm::vec4& c) { return c.z - c.x; });
    polygon = cut(polygon, [](const glm::vec4& c) { return c.z + c.x; });
    polygon = cut(polygon, [](const glm::vec4& c) { return c.z - c.y; });
    polygon = cut(polygon, [](const glm::vec4& c) { return c.z + c.y; });
    for (std::size_t i = 2; i < polygon.size(); ++i)
        if (const auto value = interpolated({polygon[0], polygon[i - 1], polygon[i]}, place))
            return value;
    return std::nullopt;
}

/// The exact values over a square of the picture, extreme at its corners, widened by a share.
Interval values_around(const Drawn& drawn, const glm::dvec2& place, double half, double share) {
    Interval range{std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
    for (const double x : {-half, half})
        for (const double y : {-half, half}) {
            const double value =
                value_along(drawn, line_of_sight(drawn.scene.camera, place.x + x, place.y + y));
            range = {std::min(range.low, value), std::max(range.high, value)};
        }
    const glm::dvec3 sizes = glm::abs(drawn.values);
    return widened(range, share * std::max({sizes.x, sizes.y, sizes.z}));
}

double span_of(const Interval& range) {
    return range.high - range.low;
}

/// And telling the place leaves less of the value open than an error of the value alone.
TEST(ClippedAttribute, is_that_of_a_place_that_is_told) {
    Dice dice(7);
    int compared = 0;
    int cut_and_narrower = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Drawn drawn = large_triangle(dice);
        const glm::vec2 place(static_cast<float>(dice.below(side)) + 0.5F,
                              static_cast<float>(dice.below(side)) + 0.5F);
        const std::optional<double> value = rasterized(drawn, place);
        if (!value) continue;
        const Camera& camera = drawn.scene.camera;
        const glm::dvec3 direction = line_of_sight(camera, place.x, place.y);
        const DepthModel model{.near = camera.near, .clamp = true};
        const double reach = lateral_error(
            drawn.scene, model, depth_on_triangle(drawn.scene, 0, direction) * direction);
        const CoveredPixel pixel{direction, reach, {.standard_near = camera.near}};
        const DrawnAttribute told = drawn_attribute(drawn.scene, 0, pixel);
        if (!std::isfinite(told.share) || !std::isfinite(told.aside)) continue;
        ++compared;
        const Interval range = values_around(drawn, place, reach + told.aside, told.share);
        EXPECT_TRUE(range.contains(*value))
            << i << ": " << *value << " of " << range.low << " to " << range.high;
        const double without = attribute_error(drawn.scene, 0, pixel);
        const Interval other = values_around(drawn, place, reach, without);
        cut_and_narrower += told.aside > 0 && span_of(range) < 0.5 * span_of(other) ? 1 : 0;
    }
    EXPECT_GT(compared, 5000);
    EXPECT_GT(cut_and_narrower, compared / 2);
}

/// Another program's clipping may leave some of a triangle that lies beside the picture: whatever
/// it shows there.
TEST(ClippedAttribute, may_be_anything_where_exact_clipping_leaves_no_triangle) {
    Dice dice(1);
    Drawn drawn = large_triangle(dice);
    for (glm::vec3& position : drawn.scene.positions) position.x = 3 - position.z;
    const CoveredPixel pixel{line_of_sight(drawn.scene.camera, 63.5, 32), 0.01, {}};
    EXPECT_TRUE(std::isinf(drawn_attribute(drawn.scene, 0, pixel).share));
    EXPECT_TRUE(std::isinf(attribute_error(drawn.scene, 0, pixel)));
}

} // namespace
} // namespace shadowproof
