// What the judge admits of a driver that keeps colours in bytes.
#include "compare/driver/lighting/lighting_arithmetic.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof {
namespace {

/// Of a shadowed surface whose decal comes to `steps` of 255, under full ambient light.
LightingInputs shadowed(double steps) {
    const Interval decal{steps / 255, steps / 255};
    LightingInputs inputs;
    inputs.decal = {decal, decal, decal};
    inputs.ambient = glm::dvec3(1);
    return inputs;
}

struct Bytes {
    int lowest = 0;
    int highest = 0;
    bool operator==(const Bytes&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Bytes& bytes) {
    return out << bytes.lowest << ".." << bytes.highest;
}

Bytes admitted(ColorModel::Arithmetic arithmetic, const ByteErrors& bytes, double steps) {
    const ColorModel model{.arithmetic = arithmetic, .bytes = bytes};
    const Interval red = predicted_color(model, shadowed(steps))[0];
    return {static_cast<int>(std::ceil(255 * red.low)),
            static_cast<int>(std::floor(255 * red.high))};
}

constexpr auto one_pass = ColorModel::Arithmetic::four_stages;
constexpr auto three_passes = ColorModel::Arithmetic::three_passes;

TEST(OverwrittenByte, is_the_nearest_on_llvmpipe) {
    for (const double rest : {-0.49, -0.3, 0.0, 0.3, 0.49})
        EXPECT_EQ(admitted(one_pass, llvmpipe_bytes, 61 + rest), (Bytes{61, 61})) << rest;
    EXPECT_EQ(admitted(one_pass, llvmpipe_bytes, 61.5), (Bytes{61, 62}));
}

TEST(OverwrittenByte, is_on_hardware_no_further_off_than_its_tolerance) {
    for (const double rest : {-0.39, -0.3, 0.0, 0.3, 0.39})
        EXPECT_EQ(admitted(one_pass, hardware_bytes, 61 + rest), (Bytes{61, 61})) << rest;
    for (const double rest : {0.41, 0.5, 0.59})
        EXPECT_EQ(admitted(one_pass, hardware_bytes, 61 + rest), (Bytes{61, 62})) << rest;
}

TEST(BlendedByte, of_hardware_may_come_of_a_float_or_of_a_byte) {
    for (const double rest : {-0.49, 0.0, 0.49})
        EXPECT_EQ(admitted(three_passes, llvmpipe_bytes, 61 + rest), (Bytes{61, 61})) << rest;
    // Twice the tolerance: before the product, and of it.
    EXPECT_EQ(admitted(three_passes, hardware_bytes, 61), (Bytes{60, 62}));
    EXPECT_EQ(admitted(three_passes, hardware_bytes, 61.3), (Bytes{61, 62}));
}

} // namespace
} // namespace shadowproof
