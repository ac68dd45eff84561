#include "scenes/orientation.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace shadowproof {
namespace {

constexpr std::uint32_t seed = 20260211;

using Exact = std::array<mpq_class, 3>;

Exact exact(const glm::dvec3& v) {
    return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)};
}

/// By the rule of Sarrus.
int sign_of_rows(const Exact& p, const Exact& q, const Exact& r) {
    const mpq_class sum = p[0] * q[1] * r[2] + p[1] * q[2] * r[0] + p[2] * q[0] * r[1] -
                          p[2] * q[1] * r[0] - p[1] * q[0] * r[2] - p[0] * q[2] * r[1];
    return sgn(sum);
}

Exact minus(const Exact& p, const Exact& q, const mpq_class& times = 1) {
    return {p[0] - times * q[0], p[1] - times * q[1], p[2] - times * q[2]};
}

int sign(double value) {
    return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

/// Places whose coordinates are of one size, or of all that floats hold.
glm::dvec3 any_place(std::mt19937& random, bool of_all_sizes) {
    glm::dvec3 place;
    for (int k = 0; k < 3; ++k) {
        const double mantissa = static_cast<double>(random() % 17) - 8;
        const int exponent = of_all_sizes ? static_cast<int>(random() % 180) - 120 : 0;
        place[k] = static_cast<double>(static_cast<float>(std::ldexp(mantissa / 7, exponent)));
    }
    return place;
}

TEST(Orientation, has_the_sign_of_the_determinant_in_rationals) {
    std::mt19937 random(seed);
    int zeros = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const bool wide = trial % 2 == 0;
        const glm::dvec3 a = any_place(random, wide);
        const glm::dvec3 b = any_place(random, wide);
        const glm::dvec3 c = any_place(random, wide);
        // Often in the plane, or as near to it as doubles come.
        glm::dvec3 at = trial % 3 == 0 ? 0.5 * (b + c) : any_place(random, wide);
        if (trial % 6 == 0) at.x = std::nextafter(at.x, 1e300);
        const double w = trial % 5 == 0 ? 0 : 1;
        const Exact from = exact(a);
        const int expected = sign_of_rows(minus(exact(b), from), minus(exact(c), from),
                                          minus(exact(at), from, mpq_class(w)));
        zeros += expected == 0 ? 1 : 0;
        ASSERT_EQ(sign(orientation(a, b, c, glm::dvec4(at, w))), expected)
            << "seed " << seed << ", trial " << trial;
    }
    EXPECT_GT(zeros, 100);
}

TEST(Orientation, tells_what_doubles_lose) {
    // b - a rounds to -1: doubles find no area.
    const glm::dvec3 a{1, 0, 0};
    const glm::dvec3 b{1e-20F, 0, 0};
    const glm::dvec3 c{0, 0, 0};
    EXPECT_EQ(orientation(a, b, c, {0, 0, 1, 1}), 0) << "all on one line";
    const glm::dvec3 d{1e-20F, 1e-30F, 0};
    EXPECT_GT(orientation(a, d, c, {0, 0, 1, 1}), 0);
    EXPECT_LT(orientation(a, c, d, {0, 0, 1, 1}), 0);
}

TEST(SideOfEdge, is_the_opposite_for_the_edge_run_the_other_way_and_never_zero_on_it) {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 5000; ++trial) {
        const glm::dvec3 a = any_place(random, false);
        const glm::dvec3 b = any_place(random, false);
        const glm::dvec4 light(any_place(random, false), trial % 2);
        const glm::dvec3 place =
            trial % 3 == 0 ? 0.5 * (a + b) : (trial % 3 == 1 ? a : any_place(random, false));
        const int one = side_of_edge(light, a, b, {place, 1});
        ASSERT_EQ(side_of_edge(light, b, a, {place, 1}), -one)
            << "seed " << seed << ", trial " << trial;
        const glm::dvec3 plane = glm::cross(light.w * a - glm::dvec3(light), b - a);
        if (glm::length(plane) > 1e-9) {
            ASSERT_NE(one, 0) << "seed " << seed << ", trial " << trial;
        }
    }
}

TEST(SideOfTriangle, is_never_zero_in_its_plane_and_the_same_as_a_real_move_leads_to) {
    const glm::dvec3 a{1, 2, 3};
    const auto at = [&](const glm::dvec3& b, const glm::dvec3& c) {
        const int side = side_of_triangle(a, b, c, {a, 1});
        EXPECT_EQ(side_of_triangle(a, c, b, {a, 1}), -side);
        const double e = 0x1p-10;
        const double moved =
            orientation(a, b, c, glm::dvec4(a + glm::dvec3(e, e * e, e * e * e), 1));
        EXPECT_EQ(side, moved > 0 ? 1 : -1);
        return side;
    };
    EXPECT_EQ(at({1, 3, 3}, {1, 2, 4}), 1);  // normal (1, 0, 0)
    EXPECT_EQ(at({2, 2, 3}, {1, 2, 4}), -1); // (0, -1, 0)
    EXPECT_EQ(at({2, 2, 3}, {1, 3, 3}), 1);  // (0, 0, 1)
    EXPECT_EQ(at({2, 4, 3}, {1, 2, 4}), 1);  // (2, -1, 0)
    EXPECT_EQ(side_of_triangle(a, {1, 3, 3}, {1, 2, 4}, {0.5, 9, 9, 1}), -1);
}

/// A place along a direction, far enough that nothing else counts, lies where the direction does.
TEST(Sides, of_a_direction_are_those_of_places_far_along_it) {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 2000; ++trial) {
        const glm::dvec3 a = any_place(random, false);
        const glm::dvec3 b = any_place(random, false);
        const glm::dvec3 c = any_place(random, false);
        const glm::dvec3 along = any_place(random, false);
        const glm::dvec4 light(any_place(random, false), trial % 2);
        const glm::dvec4 far(0x1p60 * along, 1);
        const auto is_along = [&](const glm::dvec3& plane) {
            return std::abs(glm::dot(plane, along)) < 1e-6;
        };
        if (!is_along(glm::cross(light.w * a - glm::dvec3(light), b - a))) {
            EXPECT_EQ(side_of_edge(light, a, b, {along, 0}), side_of_edge(light, a, b, far));
        }
        if (!is_along(glm::cross(b - a, c - a))) {
            EXPECT_EQ(side_of_triangle(a, b, c, {along, 0}), side_of_triangle(a, b, c, far));
        }
    }
    // In the plane x = 0, and moved off it.
    const glm::dvec3 up{0, 1, 0};
    EXPECT_EQ(side_of_edge({0, 0, 1, 1}, {0, 0, 0}, up, {0, 1, 1, 0}),
              -side_of_edge({0, 0, 1, 1}, up, {0, 0, 0}, {0, 1, 1, 0}));
    EXPECT_EQ(side_of_triangle({0, 0, 0}, up, {0, 0, 1}, {0, 1, 1, 0}), 1);
}

} // namespace
} // namespace shadowproof
