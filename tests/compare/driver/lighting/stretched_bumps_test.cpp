// Bumps over stretched texels: the range holds what floats make of Blinn's formula, and little
// more.
#include "compare/driver/lighting/stretched_bumps.h"
#include "scenes/surface/texel_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <random>
#include <vector>

namespace shadowproof {
namespace {

class StretchedBumps : public testing::Test {
protected:
    std::mt19937 random{1978};
    double number() { return std::uniform_real_distribution<double>(-1, 1)(random); }
    glm::dvec3 direction() {
        return glm::normalize(glm::dvec3(number(), number(), number()) + glm::dvec3(0, 0, 1e-3));
    }
    /// A triangle around the origin, within 30 degrees of the x-y plane, its picture any.
    Scene scene() {
        Scene scene;
        for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
            scene.positions.emplace_back(at.x + 0.2 * number(), at.y + 0.2 * number(),
                                         0.2 * number());
            scene.surfaces.push_back({.tangent = {1, 0, 0, 1},
                                      .bump_at = {at.x + 0.3 * number(), at.y + 0.3 * number()}});
        }
        scene.triangles = {{0, 1, 2}};
        scene.textures.push_back({.name = "relief", .texels = Image<glm::vec4>(16, 64)});
        scene.materials.push_back(
            {.name = "relief", .bump = Bump::height_field, .bump_map = 0, .height_in_space = true});
        scene.meshes.push_back({.name = "relief", .triangle_count = 1});
        return scene;
    }
    TangentFrame frame() {
        TangentFrame frame;
        frame.normal = glm::normalize(glm::dvec3(0.3 * number(), 0.3 * number(), 1));
        frame.tangent = glm::normalize(glm::cross(direction(), frame.normal));
        frame.bitangent = glm::cross(frame.normal, frame.tangent);
        return frame;
    }
};

/// As bump_eye_space.frag computes it, in axes that the world's are turned into.
glm::vec3 in_floats(const TexelSides& sides, const glm::mat3& turn, const glm::vec3& normal,
                    const glm::vec2& slope) {
    const glm::vec3 along = turn * glm::vec3(sides.along);
    const glm::vec3 down = turn * glm::vec3(sides.down);
    const float area = glm::dot(normal, glm::cross(along, down));
    const glm::vec3 gradient =
        slope.x * glm::cross(down, normal) + slope.y * glm::cross(normal, along);
    return normal - gradient / area;
}

TEST_F(StretchedBumps, at_a_point_are_the_truths_formula) {
    for (int i = 0; i < 1000; ++i) {
        const Scene made = scene();
        const TangentFrame axes = frame();
        const glm::dvec2 slope(0.01 * number(), 0.01 * number());
        for (const double side : {1.0, -1.0}) {
            const VectorRange range = normal_over_texel_sides(made, 0, axes, side, range_of(slope));
            const glm::dvec3 front =
                side * axes.normal -
                height_gradient(texel_sides(made, 0), side * axes.normal, slope);
            const glm::dvec3 seen = side * front;
            const glm::dvec3 expected(glm::dot(seen, axes.tangent), glm::dot(seen, axes.bitangent),
                                      glm::dot(seen, axes.normal));
            EXPECT_LT(glm::distance(middle(range.box), expected), 1e-9 * glm::length(expected));
            EXPECT_EQ(range.distance, 0);
        }
    }
}

TEST_F(StretchedBumps, hold_what_floats_make_of_a_normal_that_is_rounded) {
    std::vector<double> reaches;
    for (int i = 0; i < 20000; ++i) {
        const Scene made = scene();
        TangentFrame axes = frame();
        axes.normal_off = 8 * 0x1p-24;
        // Of every third the normal leans by 45 to 89 degrees.
        const double steep = i % 3 == 0 ? 1 : 0.01;
        const glm::dvec2 slope(steep * number(), steep * number());
        const VectorRange range = normal_over_texel_sides(made, 0, axes, 1, range_of(slope));
        const glm::dvec3 off(number(), number(), number());
        const glm::dvec3 forward = direction();
        const glm::dvec3 right = glm::normalize(glm::cross(direction(), forward));
        const glm::dmat3 turn(right, glm::cross(forward, right), forward);
        const glm::vec3 normal(turn * (axes.normal + axes.normal_off * 0.5 * off));
        const glm::dvec3 drawn =
            glm::transpose(turn) *
            glm::dvec3(in_floats(texel_sides(made, 0), glm::mat3(turn), normal, glm::vec2(slope)));
        const glm::dvec3 in_axes(glm::dot(drawn, axes.tangent), glm::dot(drawn, axes.bitangent),
                                 glm::dot(drawn, axes.normal));
        glm::dvec3 outside(0);
        for (int k = 0; k < 3; ++k) {
            const Interval& component = range.box[static_cast<std::size_t>(k)];
            outside[k] = std::max({component.low - in_axes[k], in_axes[k] - component.high, 0.0});
        }
        // The slopes given to floats are rounded, for which the caller widens them.
        ASSERT_LE(glm::length(outside), range.distance + 2 * 0x1p-24 * glm::length(in_axes)) << i;
        if (steep < 1) reaches.push_back(radius(range) / glm::length(in_axes));
    }
    std::ranges::sort(reaches);
    EXPECT_LT(reaches[reaches.size() / 2], 256 * 0x1p-24);
}

TEST_F(StretchedBumps, on_a_triangle_without_area_in_the_texture_are_none) {
    Scene made = scene();
    for (Surface& surface : made.surfaces) surface.bump_at = {0.5, 0.5};
    const VectorRange range =
        normal_over_texel_sides(made, 0, frame(), 1, range_of(glm::dvec2(0.5, 0.5)));
    EXPECT_EQ(middle(range.box), glm::dvec3(0, 0, 1));
    EXPECT_EQ(reach(range), 0);
}

} // namespace
} // namespace shadowproof
