#include "compare/report/color_picture.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

Rgb shown(const Shading& shading, glm::dvec3 Shading::*direction) {
    return tangent_space_picture(Image<Shading>(1, 1, shading), direction).at(0, 0);
}

// B = w N x T of the front; on a back face the vector is negated, not the frame.
TEST(color_picture, shows_directions_along_tangent_bitangent_and_normal) {
    Shading shading;
    shading.normal = {0, 0, 1};
    shading.tangent = {1, 0, 0};
    const auto light = [&](const glm::dvec3& v) {
        shading.to_light = v;
        return shown(shading, &Shading::to_light);
    };
    EXPECT_EQ(light({1, 0, 0}), (Rgb{255, 128, 128}));
    EXPECT_EQ(light({0, 1, 0}), (Rgb{128, 255, 128}));
    EXPECT_EQ(light({0, 0, 1}), (Rgb{128, 128, 255}));
    shading.hand = -1;
    EXPECT_EQ(light({0, 1, 0}), (Rgb{128, 0, 128}));
    shading.hand = 1;
    shading.side = -1;
    shading.normal = {0, 0, -1};
    EXPECT_EQ(light({0, 1, 0}), (Rgb{128, 0, 128}));
    EXPECT_EQ(light({0, 0, -1}), (Rgb{128, 128, 255}));
    shading.half = {1, 0, 0};
    EXPECT_EQ(shown(shading, &Shading::half), (Rgb{0, 128, 128}));
    shading.tangent = {0, 0, 0};
    EXPECT_EQ(light({0, 0, 1}), Rgb{});
}

} // namespace
} // namespace shadowproof
