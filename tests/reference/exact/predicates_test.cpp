#include "reference/exact/bounded.h"
#include "reference/exact/exact.h"
#include "reference/exact/predicates.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

namespace shadowproof {
namespace {

constexpr std::uint32_t seed = 20260101;

/// What the arithmetics of exact.h are held against.
struct RationalArithmetic {
    struct Number {
        mpq_class value;
        int sign() const { return sgn(value); }
        friend Number operator+(const Number& a, const Number& b) { return {a.value + b.value}; }
        friend Number operator-(const Number& a, const Number& b) { return {a.value - b.value}; }
        friend Number operator*(const Number& a, const Number& b) { return {a.value * b.value}; }
    };
    Number number(double a) const { return {mpq_class(a)}; }
    Number direction(double a) const { return number(a); }
    Number difference(double a, double b) const { return {mpq_class(a) - mpq_class(b)}; }
};

/// Doubles of many magnitudes, some equal, some zero.
double any_double(std::mt19937& random) {
    std::uniform_int_distribution<int> kind(0, 9);
    if (kind(random) == 0) return 0;
    std::uniform_real_distribution<double> mantissa(-1, 1);
    std::uniform_int_distribution<int> exponent(-30, 30);
    return std::ldexp(mantissa(random), exponent(random));
}

TEST(Limbs, sums_and_products_of_random_doubles_have_the_sign_of_their_rationals) {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 20000; ++trial) {
        bool left_range = false;
        const LimbsArithmetic exact{&left_range};
        std::array<double, 6> x{};
        for (double& value : x) value = any_double(random);
        // A determinant whose value is the rounding error of a larger one.
        const double nearly = x[0] * x[1] + x[2] * x[3];
        const auto formula = [&](const auto& arithmetic) {
            const auto sum = arithmetic.number(x[0]) * arithmetic.number(x[1]) +
                             arithmetic.number(x[2]) * arithmetic.number(x[3]);
            return (sum - arithmetic.number(nearly)) * arithmetic.difference(x[4], x[5]);
        };
        ASSERT_EQ(formula(exact).sign(), formula(RationalArithmetic{}).sign())
            << "seed " << seed << ", trial " << trial;
    }
}

/// A double whose size is anything from `smallest` to limbs_largest, with all bits or a few.
double within_range(std::mt19937& random, double smallest) {
    std::uniform_real_distribution<double> exponent(std::log2(smallest), std::log2(limbs_largest));
    const double size = std::clamp(std::exp2(exponent(random)), smallest, limbs_largest);
    const double few = std::ldexp(1.0, std::ilogb(size) + 1);
    const double chosen = random() % 4 == 0 && few <= limbs_largest ? few : size;
    return random() % 2 == 0 ? chosen : -chosen;
}

TEST(Limbs, hold_sums_of_degree_six_of_inputs_from_one_end_of_their_range_to_the_other) {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 20000; ++trial) {
        std::array<double, 12> x{};
        for (double& value : x) value = within_range(random, limbs_smallest);
        // Now and then ends themselves, whose products have most digits.
        for (double& value : x)
            if (random() % 8 == 0) value = random() % 2 == 0 ? limbs_smallest : -limbs_largest;
        const double d = within_range(random, limbs_smallest_direction);
        const auto formula = [&](const auto& arithmetic) {
            const auto product = [&](int first) {
                auto result = arithmetic.direction(d);
                for (int k = 0; k < 5; ++k) {
                    const auto i = static_cast<std::size_t>(first + k);
                    result = result * arithmetic.difference(x[i], x[i + 1]);
                }
                return result;
            };
            return product(0) - product(6) + product(3);
        };
        bool left_range = false;
        ASSERT_EQ(formula(LimbsArithmetic{&left_range}).sign(),
                  formula(RationalArithmetic{}).sign())
            << "seed " << seed << ", trial " << trial;
        ASSERT_FALSE(left_range);
    }
}

TEST(Limbs, an_input_beyond_its_range_is_noticed) {
    const auto leaves = [](const auto& use) {
        bool left_range = false;
        use(LimbsArithmetic{&left_range});
        return left_range;
    };
    for (const double inside : {0.0, -0.0, 1e-20, -1e20})
        EXPECT_FALSE(leaves([&](const auto& a) { a.number(inside), a.difference(1, inside); }));
    for (const double beyond : {0.99e-20, -1.01e20, 5e-324, 1e308}) {
        EXPECT_TRUE(leaves([&](const auto& a) { a.number(beyond); })) << beyond;
        EXPECT_TRUE(leaves([&](const auto& a) { a.difference(beyond, 1); })) << beyond;
        EXPECT_TRUE(leaves([&](const auto& a) { a.difference(1, beyond); })) << beyond;
    }
    EXPECT_FALSE(leaves([](const auto& a) { a.direction(1e-90); }));
    EXPECT_TRUE(leaves([](const auto& a) { a.direction(0.99e-90); }));
}

/// Any finite double at all, by its bits; every tenth is zero.
double any_finite_double(std::mt19937_64& random) {
    for (;;) {
        const std::uint64_t bits = random();
        const double value = bits % 10 == 0 ? 0 : std::bit_cast<double>(bits);
        if (std::isfinite(value)) return value;
    }
}

TEST(Dyadic, sums_and_products_of_any_finite_doubles_have_the_sign_of_their_rationals) {
    std::mt19937_64 random(seed);
    for (int trial = 0; trial < 5000; ++trial) {
        std::array<double, 6> x{};
        for (double& value : x) value = any_finite_double(random);
        // Every other time a difference that cancels, but for its smallest term.
        if (trial % 2 == 0) x[2] = x[0], x[3] = -x[1];
        const auto formula = [&](const auto& arithmetic) {
            const auto sum = arithmetic.number(x[0]) * arithmetic.number(x[1]) +
                             arithmetic.number(x[2]) * arithmetic.number(x[3]);
            return (sum - arithmetic.number(x[4])) * arithmetic.difference(x[5], x[4]);
        };
        ASSERT_EQ(formula(DyadicArithmetic{}).sign(), formula(RationalArithmetic{}).sign())
            << "seed " << seed << ", trial " << trial;
    }
}

TEST(Predicates, inputs_that_limbs_would_lose_are_decided_all_the_same) {
    const Predicates predicates;
    // The normal is (1e-120, -1e-30, -1e-30), and what is seen of it 1e-90 - 2 * 0.75e-90: the
    // first term is a product of numbers of which limbs have no room for the last bits.
    const Corners t{{0, 0, 0}, {1e30, 1e-60, 0}, {1e30, 0, 1e-60}};
    const glm::dvec3 above{1e30, 0.75e-60, 0.75e-60};
    EXPECT_EQ(predicates.side({above, 1}, t).sign, 1);
    EXPECT_EQ(predicates.side({-above, 1}, t).sign, -1);
    EXPECT_EQ(predicates.side({0.5 * (t.b + t.c), 1}, t).sign, 0);
}

TEST(Bounded, a_sign_it_is_certain_of_is_right_and_near_zero_it_is_not_certain) {
    std::mt19937 random(seed);
    int uncertain = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::array<double, 4> x{};
        for (double& value : x) value = any_double(random);
        const double nearly = x[0] * x[1] + x[2] * x[3];
        const auto formula = [&](const auto& arithmetic) {
            return arithmetic.number(x[0]) * arithmetic.number(x[1]) +
                   arithmetic.number(x[2]) * arithmetic.number(x[3]) - arithmetic.number(nearly);
        };
        const std::optional<int> sign = formula(BoundedArithmetic{}).sign();
        if (sign)
            ASSERT_EQ(*sign, formula(RationalArithmetic{}).sign())
                << "seed " << seed << ", trial " << trial;
        else
            ++uncertain;
    }
    EXPECT_GT(uncertain, 10000);
}

TEST(Predicates, a_point_in_a_triangles_plane_is_on_neither_side) {
    const Predicates predicates;
    const Corners t{{0.1F, 0.7F, 0.3F}, {1.1F, 0.9F, 0.2F}, {0.4F, 1.3F, 0.9F}};
    // a + 2 (b - a) - (c - a), exact in doubles as the corners are floats.
    const glm::dvec3 inside = t.a + 2.0 * (t.b - t.a) - (t.c - t.a);
    EXPECT_EQ(predicates.side({inside, 1}, t).sign, 0);
    EXPECT_EQ(predicates.side({inside, 1}, t).exactness, Exactness::degenerate);
    const glm::dvec3 normal{0.14, -0.65, 0.52};
    const glm::dvec3 above = inside + 0x1p-50 * normal;
    EXPECT_NE(predicates.side({above, 1}, t).sign, 0);
    EXPECT_EQ(predicates.side({above, 1}, t).exactness, Exactness::exact);
}

TEST(Predicates, a_direction_sees_the_side_that_points_far_along_it_see) {
    const Predicates predicates;
    const Corners t{{0.1F, 0.7F, 0.3F}, {1.1F, 0.9F, 0.2F}, {0.4F, 1.3F, 0.9F}};
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int trial = 0; trial < 1000; ++trial) {
        const glm::dvec3 direction(any(random), any(random), any(random));
        EXPECT_EQ(predicates.side({direction, 0}, t).sign,
                  predicates.side({0x1p60 * direction, 1}, t).sign)
            << "seed " << seed << ", trial " << trial;
    }
    const glm::dvec3 along = (t.b - t.a) - 2.0 * (t.c - t.a);
    EXPECT_EQ(predicates.side({along, 0}, t).sign, 0);
    EXPECT_EQ(predicates.side({along, 0}, t).exactness, Exactness::degenerate);
}

TEST(Predicates, far_along_the_plane_through_an_edge_and_the_sun_the_eyes_side_decides) {
    const Predicates predicates;
    const RayPoint infinity{.kind = RayPoint::Kind::infinity};
    const glm::dvec3 a{0, 0, -2};
    const glm::dvec3 b{0, 0, -3};
    const auto sign = [&](double x, const glm::dvec3& direction) {
        return predicates.shadow_edge({{x, -5, 0}, direction, {0, 1, 0, 0}}, infinity, a, b).sign;
    };
    const int right = sign(1, {1, 0, -1});
    EXPECT_NE(right, 0);
    EXPECT_EQ(sign(-1, {1, 0, -1}), right);
    EXPECT_EQ(sign(1, {-1, 0, -1}), -right);
    EXPECT_EQ(sign(1, {0, 0.5, -1}), right);
    EXPECT_EQ(sign(-1, {0, 0.5, -1}), -right);
    EXPECT_EQ(sign(0, {0, 0.5, -1}), 0);
}

TEST(Predicates, only_the_exactly_opposite_direction_runs_from_the_light) {
    const Predicates predicates;
    const glm::dvec4 light{0.25, 0.75, -0.5, 0};
    const auto runs = [&](const glm::dvec3& d) {
        return predicates.runs_from_light({{0, 0, 0}, d, light});
    };
    EXPECT_TRUE(runs({-0.5, -1.5, 1}));
    EXPECT_FALSE(runs({0.5, 1.5, -1}));
    EXPECT_FALSE(runs({-0.5, -1.5, std::nextafter(1.0, 2.0)}));
}

TEST(Predicates, a_point_exactly_on_a_cone_is_on_neither_side_of_it) {
    const Predicates predicates;
    const RayPoint q{.kind = RayPoint::Kind::depth, .depth = 2};
    // An axis of length 3 and cosine 1 stand for the cosine 1/3, which (2, -1, 2) has exactly.
    const Cone cone{{1, 2, -4}, {0, -3, 0}, 1};
    const auto at = [&](const glm::dvec3& direction) {
        return predicates.within_cone({{3, 3, 0}, direction, {1, 2, -4, 1}}, q, cone);
    };
    EXPECT_EQ(at({0, -1, -1}).sign, 0);
    EXPECT_EQ(at({0, -1, -1}).exactness, Exactness::degenerate);
    EXPECT_EQ(at({0, -1 - 0x1p-52, -1}).sign, 1);
    EXPECT_EQ(at({0, -1 + 0x1p-53, -1}).sign, -1);
    EXPECT_EQ(at({0, 5, -1}).sign, -1);
}

TEST(Predicates, a_tie_at_an_edge_is_broken_the_other_way_for_the_triangle_on_its_other_side) {
    const Predicates predicates;
    const EyeRay ray{{0, 0, 0}, {0, 0, -1}, {2, 0, -4, 1}};
    const RayPoint q{.kind = RayPoint::Kind::depth, .depth = 4};
    // The segment from the light to (0, 0, -4) passes through (1, 0, -4).
    const glm::dvec3 a{1, 0, -3};
    const glm::dvec3 b{1, 0, -5};
    ASSERT_EQ(predicates.shadow_edge(ray, q, a, b).sign, 0);
    const int one_way = predicates.shadow_edge_untied(ray, q, a, b).sign;
    EXPECT_NE(one_way, 0);
    EXPECT_EQ(predicates.shadow_edge_untied(ray, q, b, a).sign, -one_way);
}

TEST(Predicates, a_tie_at_a_plane_is_broken_by_the_first_axis_that_the_plane_is_not_along) {
    const Predicates predicates;
    const EyeRay ray{{2, 3, 4}, {0, 0, -1}, {0, 9, 0, 1}};
    const RayPoint eye{.kind = RayPoint::Kind::depth, .depth = 0};
    const auto untied = [&](const glm::dvec3& b, const glm::dvec3& c) {
        EXPECT_EQ(predicates.side_of_point(ray, eye, {ray.start, b, c}).sign, 0);
        const int sign = predicates.side_of_point_untied(ray, eye, {ray.start, b, c}).sign;
        EXPECT_EQ(predicates.side_of_point_untied(ray, eye, {ray.start, c, b}).sign, -sign);
        return sign;
    };
    EXPECT_EQ(untied({2, 4, 4}, {2, 3, 5}), 1);  // normal (1, 0, 0)
    EXPECT_EQ(untied({3, 3, 4}, {2, 3, 5}), -1); // (0, -1, 0)
    EXPECT_EQ(untied({3, 3, 4}, {2, 4, 4}), 1);  // (0, 0, 1)
    EXPECT_EQ(untied({3, 5, 4}, {2, 3, 5}), 1);  // (2, -1, 0)
}

} // namespace
} // namespace shadowproof
