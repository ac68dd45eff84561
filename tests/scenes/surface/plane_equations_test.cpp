#include "scenes/surface/plane_equations.h"
#include "scenes/surface/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace shadowproof {
namespace {

using Positions = std::array<glm::dvec3, 3>;
using Places = std::array<glm::dvec2, 3>;

/// Integers below 64, so that products of three of them and sums of those are exact in double.
class Integers {
public:
    explicit Integers(unsigned seed) : random_(seed) {}
    glm::dvec3 point() { return {next(), next(), next()}; }
    Positions positions() { return {point(), point(), point()}; }
    Places places() {
        return {glm::dvec2(next(), next()), glm::dvec2(next(), next()), glm::dvec2(next(), next())};
    }

private:
    std::mt19937 random_;
    double next() { return static_cast<double>(random_() % 128) - 64; }
};

constexpr int triangles = 2000;
constexpr unsigned seed = 20000705;

TEST(plane_equations, hold_at_all_corners_and_a_is_twice_the_area_in_the_texture) {
    Integers integers(seed);
    for (int i = 0; i < triangles; ++i) {
        const Positions positions = integers.positions();
        const Places at = integers.places();
        const PlaneEquations planes = plane_equations(positions, at);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(planes.a * positions[k] + planes.b * at[k].x + planes.c * at[k].y + planes.d,
                      glm::dvec3(0))
                << "seed " << seed << ", triangle " << i;
    }
    // A right triangle with legs of 4 and 3 texels.
    EXPECT_EQ(plane_equations(integers.positions(), {{{1, 1}, {5, 1}, {1, 4}}}).a, 12);
}

/// dP/ds and dP/dt solve e1 = s1 P_s + t1 P_t, e2 = s2 P_s + t2 P_t (MikkTSpace, section 2.1).
TEST(plane_equations, give_the_directions_of_the_direct_edge_formula) {
    Integers integers(seed + 1);
    for (int i = 0; i < triangles; ++i) {
        const Positions p = integers.positions();
        const Places at = integers.places();
        const PlaneEquations planes = plane_equations(p, at);
        if (planes.a == 0) continue;
        const glm::dvec2 image = at[1] - at[0];
        const glm::dvec2 other = at[2] - at[0];
        const glm::dvec3 along_s = (other.y * (p[1] - p[0]) - image.y * (p[2] - p[0])) / planes.a;
        const glm::dvec3 along_t = (image.x * (p[2] - p[0]) - other.x * (p[1] - p[0])) / planes.a;
        if (along_s == glm::dvec3(0) || along_t == glm::dvec3(0)) continue;
        const TextureDirections found = directions_of(planes);
        // A few roundings each.
        EXPECT_LT(glm::distance(found.along_s, glm::normalize(along_s)), 1e-14) << "triangle " << i;
        EXPECT_LT(glm::distance(found.along_t, glm::normalize(along_t)), 1e-14) << "triangle " << i;
    }
}

/// A flat triangle in z = 0, seen from +z.
struct Flat {
    Positions positions{glm::dvec3(0, 0, 0), glm::dvec3(3, 1, 0), glm::dvec3(1, 4, 0)};
    Places at;
};

std::vector<glm::vec4> made_tangents(const Flat& flat) {
    std::vector<TexturedCorner> corners;
    for (std::size_t k = 0; k < 3; ++k)
        corners.push_back({glm::vec3(flat.positions[k]), {0, 0, 1}, glm::vec2(flat.at[k])});
    return make_tangents(corners);
}

// t grows down the picture: an upright one has A < 0, and its bitangent runs against t.
TEST(plane_equations, agree_with_the_made_tangents_of_a_flat_triangle_upright_or_mirrored) {
    const Flat upright{.at = {{{0.25, 0.75}, {0.75, 0.625}, {0.375, 0.125}}}};
    Flat mirrored = upright;
    for (glm::dvec2& at : mirrored.at) at.x = 1 - at.x;
    for (const Flat& flat : {upright, mirrored}) {
        const PlaneEquations planes = plane_equations(flat.positions, flat.at);
        const TextureDirections found = directions_of(planes);
        const bool is_mirrored = planes.a > 0;
        EXPECT_EQ(is_mirrored, flat.at == mirrored.at);
        for (const glm::vec4& tangent : made_tangents(flat)) {
            EXPECT_LT(glm::distance(glm::dvec3(tangent), found.along_s), 1e-6); // is float
            EXPECT_EQ(tangent.w, is_mirrored ? -1 : 1);
            const glm::dvec3 bitangent = static_cast<double>(tangent.w) *
                                         glm::cross(glm::dvec3(0, 0, 1), glm::dvec3(tangent));
            EXPECT_LT(glm::dot(bitangent, found.along_t), 0);
        }
    }
}

TEST(plane_equations, of_a_mirrored_skin_still_point_to_the_right_of_the_picture) {
    Integers integers(seed + 2);
    for (int i = 0; i < triangles; ++i) {
        const Positions positions = integers.positions();
        Places at = integers.places();
        const PlaneEquations planes = plane_equations(positions, at);
        for (glm::dvec2& place : at) place.x = -place.x;
        const PlaneEquations image = plane_equations(positions, at);
        EXPECT_EQ(image.a, -planes.a);
        EXPECT_EQ(image.b, planes.b); // without the negation along_s would stay as it was
        EXPECT_EQ(directions_of(image).along_s, -directions_of(planes).along_s);
        EXPECT_EQ(directions_of(image).along_t, directions_of(planes).along_t);
    }
}

TEST(plane_equations, without_area_in_the_texture_have_no_directions) {
    const Positions positions{glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)};
    const TextureDirections none =
        directions_of(plane_equations(positions, {{{0, 0}, {1, 1}, {2, 2}}}));
    EXPECT_EQ(none.along_s, glm::dvec3(0));
    EXPECT_EQ(none.along_t, glm::dvec3(0));
}

Positions between(const Positions& from, const Positions& to, double share) {
    Positions positions;
    for (std::size_t k = 0; k < 3; ++k) positions[k] = (1 - share) * from[k] + share * to[k];
    return positions;
}

// Corners are integers and times eighths, so nothing is rounded anywhere: equality, not tolerance.
TEST(plane_equations, mixed_between_key_frames_are_exactly_those_of_the_corners_between) {
    Integers integers(seed + 3);
    for (int i = 0; i < triangles; ++i) {
        const Positions from = integers.positions();
        const Positions to = integers.positions();
        const Places at = integers.places();
        for (int eighth = 0; eighth <= 8; ++eighth) {
            const double share = eighth / 8.0;
            const PlaneEquations mixed =
                mix(plane_equations(from, at), plane_equations(to, at), share);
            const PlaneEquations direct = plane_equations(between(from, to, share), at);
            ASSERT_EQ(mixed.a, direct.a) << "seed " << seed << ", triangle " << i;
            ASSERT_EQ(mixed.b, direct.b) << "seed " << seed << ", triangle " << i;
            ASSERT_EQ(mixed.c, direct.c) << "seed " << seed << ", triangle " << i;
            ASSERT_EQ(mixed.d, direct.d) << "seed " << seed << ", triangle " << i;
            // The same tangents, to the last bit.
            ASSERT_EQ(directions_of(mixed).along_s, directions_of(direct).along_s);
        }
    }
}

TEST(plane_equations, whose_texture_moves_too_are_not_linear_in_time) {
    const Positions still{glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)};
    const Places from{{{0, 0}, {1, 0}, {0, 1}}};
    const Places to{{{0, 0}, {3, 0}, {0, 3}}};
    const Places halfway{{{0, 0}, {2, 0}, {0, 2}}};
    EXPECT_NE(mix(plane_equations(still, from), plane_equations(still, to), 0.5).a,
              plane_equations(still, halfway).a);
}

// An edge turns by a right angle and grows threefold: halfway its direction is (1, 3), and the mean
// of the unit vectors at both ends (1, 1).
TEST(plane_equations, interpolated_as_unit_tangents_are_wrong_by_27_degrees) {
    const Places at{{{0, 0}, {1, 0}, {0, 1}}};
    const Positions from{glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)};
    const Positions to{glm::dvec3(0, 0, 0), glm::dvec3(0, 3, 0), glm::dvec3(0, 0, 1)};
    const PlaneEquations first = plane_equations(from, at);
    const PlaneEquations last = plane_equations(to, at);
    const glm::dvec3 exact = directions_of(mix(first, last, 0.5)).along_s;
    EXPECT_LT(glm::distance(exact, glm::normalize(glm::dvec3(1, 3, 0))), 1e-15);
    const glm::dvec3 interpolated =
        glm::normalize(0.5 * directions_of(first).along_s + 0.5 * directions_of(last).along_s);
    EXPECT_NEAR(glm::dot(exact, interpolated), 4 / std::sqrt(20), 1e-15); // cos 26.6 degrees
}

} // namespace
} // namespace shadowproof
