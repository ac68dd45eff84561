#include "reference/exact/mask_sign.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof {
namespace {

/// Two by two texels: 0 and 1 above, 1 and 0 below.
AlphaMask checkers(double least) {
    AlphaMask mask{.name = "checkers",
                   .alpha = Image<float>(2, 2),
                   .wrap_s = Wrap::clamp_to_edge,
                   .wrap_t = Wrap::clamp_to_edge};
    mask.alpha.at(1, 0) = mask.alpha.at(0, 1) = 1;
    mask.least = least;
    return mask;
}

/// The half of the square [0, 1]^2 at z = 0 below its diagonal, its coordinates those of the mask.
MaskedTriangle half_square(const AlphaMask& mask) {
    return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {glm::dvec2(0, 0), {1, 0}, {1, 1}}, &mask};
}

EyeRay down(double x, double y) {
    return {{x, y, 2}, {0, 0, -1}, {0, 0, 5, 1}};
}

TEST(MaskSign, is_that_of_alpha_less_the_cutoff_and_exact_at_ties) {
    const AlphaMask mask = checkers(0.5);
    const MaskedTriangle triangle = half_square(mask);
    for (const Filters filters : {Filters::on, Filters::off}) {
        EXPECT_EQ(mask_on_ray(filters, down(0.9, 0.1), triangle).sign, 1) << "the texel of 1";
        EXPECT_EQ(mask_on_ray(filters, down(0.2, 0.1), triangle).sign, -1) << "the texel of 0";
        // Half way between texels' centres it is 1/2, whatever the row.
        const Decision tie = mask_on_ray(filters, down(0.5, 0.125), triangle);
        EXPECT_EQ(tie.sign, 0);
        EXPECT_EQ(tie.exactness, Exactness::degenerate);
        EXPECT_EQ(mask_on_ray(filters, down(std::nextafter(0.5, 1), 0.125), triangle).sign, 1);
        EXPECT_EQ(mask_on_ray(filters, down(std::nextafter(0.5, 0), 0.125), triangle).sign, -1);
    }
}

TEST(MaskSign, before_the_light_is_taken_where_its_line_meets_the_triangle) {
    const AlphaMask mask = checkers(0.5);
    const MaskedTriangle triangle = half_square(mask);
    // A receiver at z = -5, as far below the triangle as the light is above it: what it shows at
    // (x, y) is shadowed at half of that.
    const Corners receiver{{-9, -9, -5}, {9, -9, -5}, {0, 9, -5}};
    const RayPoint q{.kind = RayPoint::Kind::surface, .surface = receiver};
    const auto sign = [&](double x, double y) {
        return mask_before_light(Filters::on, down(x, y), q, triangle).sign;
    };
    EXPECT_EQ(sign(1.8, 0.2), 1);
    EXPECT_EQ(sign(0.4, 0.2), -1);
    EXPECT_EQ(sign(1, 0.25), 0);
    EXPECT_EQ(sign(std::nextafter(1, 2), 0.25), 1);
}

TEST(MaskSign, another_program_may_read_what_its_errors_allow_and_no_more) {
    const AlphaMask mask = checkers(0.5);
    const MaskedTriangle triangle = half_square(mask);
    const auto may = [&](double x, double error, MaskReading reading) {
        return may_stand_on_ray(down(x, 0.125), triangle, {.at = glm::dvec2(error)}, reading);
    };
    EXPECT_TRUE(may(0.4995, 1e-3, MaskReading::most));
    EXPECT_FALSE(may(0.4995, 1e-3, MaskReading::least));
    EXPECT_FALSE(may(0.4995, 4e-4, MaskReading::most));
    EXPECT_TRUE(may(0.5005, 4e-4, MaskReading::least));
}

} // namespace
} // namespace shadowproof
