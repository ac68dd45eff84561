#include "scenes/surface/normalisation_cube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

namespace shadowproof {
namespace {

/// The direction of a place on a face, both coordinates in [-1, 1], written out by hand from the
/// columns sc, tc and ma of OpenGL 4.5, table 8.19.
glm::dvec3 direction(std::size_t face, double sc, double tc) {
    switch (face) {
    case 0:
        return {1, -tc, -sc};
    case 1:
        return {-1, -tc, sc};
    case 2:
        return {sc, 1, tc};
    case 3:
        return {sc, -1, -tc};
    case 4:
        return {sc, -tc, 1};
    default:
        return {-sc, -tc, -1};
    }
}

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TEST(NormalisationCube, each_texel_is_within_half_a_step_of_the_unit_vector_through_its_centre) {
    constexpr double half_step = 0.5 / 255;
    for (const int size : {1, 2, 5, 64}) {
        const NormalisationCube cube = make_normalisation_cube(size);
        for (std::size_t face = 0; face < 6; ++face)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const glm::dvec3 n = glm::normalize(
                        direction(face, (x + 0.5) / size * 2 - 1, (y + 0.5) / size * 2 - 1));
                    const glm::dvec3 texel = glm::dvec3(cube.faces[face].at(x, y)) / 255.0;
                    ASSERT_LE(largest(texel - (0.5 + 0.5 * n)), half_step * (1 + 1e-12))
                        << face << ": " << x << "," << y;
                }
    }
}

TEST(NormalisationCube, a_lookup_at_a_centre_is_the_texel_and_of_zero_is_zero) {
    const NormalisationCube cube = make_normalisation_cube(8);
    EXPECT_EQ(looked_up(cube, {0, 0, 0}), glm::dvec3(0));
    for (std::size_t face = 0; face < 6; ++face)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                const glm::dvec3 v = direction(face, (x + 0.5) / 4 - 1, (y + 0.5) / 4 - 1);
                const glm::dvec3 texel = 2.0 * glm::dvec3(cube.faces[face].at(x, y)) / 255.0 - 1.0;
                ASSERT_LT(largest(looked_up(cube, 3.0 * v) - texel), 1e-12);
            }
}

TEST(NormalisationCube, of_64_texels_a_side_makes_vectors_of_unit_length_within_its_rounding) {
    // Rounding: 1/255. Mixing: on a face normalize() has second derivatives below 2, so that
    // mixing over a cell of 2/64 a side is off by at most 2 (2/64)^2 / 8 an axis. The outer half
    // texel of a face repeats its last one, which turns the vector by at most 1/64 an axis.
    constexpr double bound = 1 / 255.0 + 2 * 2 * (2 / 64.0) * (2 / 64.0) / 8 + 2 / 64.0;
    constexpr unsigned seed = 20261122;
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    const NormalisationCube cube = make_normalisation_cube(64);
    double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const glm::dvec3 v(any(random), any(random), any(random));
        worst = std::max(worst, largest(looked_up(cube, v) - glm::normalize(v)));
    }
    EXPECT_LT(worst, bound);
    EXPECT_GT(worst, 0.5 / 255); // it is no exact normalisation
}

} // namespace
} // namespace shadowproof
