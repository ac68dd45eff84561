// What the judge admits of a driver that keeps colours in bytes.
#include "compare/driver/lighting/lighting_arithmetic.h"
#include "tests/compare/driver/lighting/one_light.h"

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
    const Interval red = tests::predicted_by_one(model, shadowed(steps))[0];
    return {static_cast<int>(std::ceil(255 * red.low)),
            static_cast<int>(std::floor(255 * red.high))};
}

constexpr auto one_pass = ColorModel::Arithmetic::four_stages;
constexpr auto three_passes = ColorModel::Arithmetic::three_passes;

/// Slopes in eye space know the sides of texels; normals do not, nor does tangent space.
TEST(OffByNature, are_vectors_made_elsewhere_and_heights_in_space_but_as_slopes_in_eye_space) {
    Scene scene;
    scene.materials.push_back({.name = "relief", .bump = Bump::height_field});
    scene.meshes.push_back({.name = "relief", .triangle_count = 1});
    constexpr auto eye = ColorModel::Axes::eye;
    for (const BumpForm form : all_bump_forms) {
        EXPECT_FALSE(is_off_by_nature({.bump_form = form}, scene));
        EXPECT_FALSE(is_off_by_nature({.axes = eye, .bump_form = form}, scene));
        EXPECT_EQ(is_exact({.bump_form = form}, scene),
                  form == BumpForm::as_given || form == BumpForm::height_field);
    }
    EXPECT_TRUE(is_off_by_nature({.vectors = VectorOrigin::at_vertices}, scene));
    EXPECT_TRUE(is_off_by_nature({.vectors = VectorOrigin::unit_at_vertices}, scene));
    EXPECT_TRUE(is_off_by_nature({.tangents = TangentSource::polygons}, scene));
    scene.materials[0].height_in_space = true;
    for (const BumpForm form : all_bump_forms) {
        const bool slopes = form != BumpForm::normal_map && form != BumpForm::indexed;
        EXPECT_TRUE(is_off_by_nature({.bump_form = form}, scene));
        EXPECT_EQ(is_off_by_nature({.axes = eye, .bump_form = form}, scene), !slopes);
        EXPECT_FALSE(is_exact({.bump_form = form}, scene));
        EXPECT_EQ(is_exact({.axes = eye, .bump_form = form}, scene),
                  form == BumpForm::as_given || form == BumpForm::height_field);
    }
}

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
