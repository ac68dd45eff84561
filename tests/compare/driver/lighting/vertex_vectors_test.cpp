// The vectors that are made at vertices, held against the arithmetic of a vertex shader, in floats.
#include "compare/driver/lighting/vertex_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <random>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

glm::vec3 unit_in_floats(const glm::vec3& v) {
    const float square = glm::dot(v, v);
    return square > 0 ? v / std::sqrt(square) : glm::vec3(0);
}

/// As lit.vert computes them.
struct FloatVectors {
    glm::vec3 light, half;
};
FloatVectors in_floats(const Scene& scene, int k, const Surface& surface, VectorOrigin origin) {
    const glm::dvec4 place = homogeneous(chosen_light(scene));
    const auto w = static_cast<float>(place.w);
    const glm::dvec3 light(place);
    const glm::vec3 high(light);
    const glm::vec3 low(light - glm::dvec3(high));
    const glm::vec3 eye_high(scene.camera.eye);
    const glm::vec3 eye_low(scene.camera.eye - glm::dvec3(eye_high));
    const glm::vec3 position = scene.positions[scene.triangles[0][k]];
    const glm::vec3 to_light = -((w * position - high) - low);
    const glm::vec3 to_eye = -((position - eye_high) - eye_low);
    glm::vec3 half = unit_in_floats(to_light) + unit_in_floats(to_eye);
    const bool make_unit = origin == VectorOrigin::unit_at_vertices;
    if (make_unit) half = unit_in_floats(half);
    const glm::vec3 n = unit_in_floats(surface.normal);
    const glm::vec3 along(surface.tangent);
    const glm::vec3 t = unit_in_floats(along - n * glm::dot(n, along));
    const glm::mat3 frame(t, surface.tangent.w * glm::cross(n, t), n);
    return {(make_unit ? unit_in_floats(to_light) : to_light) * frame, half * frame};
}

class VertexVectorsOf : public testing::TestWithParam<VectorOrigin> {
protected:
    std::mt19937 random_{20010322};
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
            const double length = glm::length(v);
            if (length > 0.1 && length < 1) return v / length;
        }
    }
    /// One triangle `far` from the origin, a light `near` to its first corner.
    Scene scene(double far, double near, bool directional) {
        Scene scene;
        const glm::dvec3 origin = far * direction();
        for (int k = 0; k < 3; ++k) {
            scene.positions.emplace_back(origin + direction());
            const glm::dvec3 normal = direction();
            // Within a thousandth of the normal, too: little is left to make a tangent of.
            const glm::dvec3 along =
                k == 1 ? glm::normalize(normal + 1e-3 * direction()) : direction();
            scene.surfaces.push_back(
                {.normal = normal, .tangent = glm::vec4(along, k == 2 ? -1 : 1)});
        }
        scene.triangles = {{0, 1, 2}};
        scene.materials.push_back({.name = "bumpy", .bump = Bump::normal_map});
        scene.meshes.push_back({.name = "bumpy", .triangle_count = 1});
        scene.camera.eye = origin + 3.0 * direction();
        Light light;
        light.kind = directional ? Light::Kind::directional : Light::Kind::point;
        light.direction = direction();
        light.position = glm::dvec3(scene.positions[0]) + near * direction();
        scene.lights = {light};
        return scene;
    }
};

TEST_P(VertexVectorsOf, floats_lie_within_the_range_at_each_corner) {
    std::vector<double> widths;
    for (int i = 0; i < 20000; ++i) {
        const double near = std::exp2(between(-12, 3));
        const Scene made = scene(i % 3 == 0 ? 1000 : 1, near, i % 5 == 0);
        for (int k = 0; k < 3; ++k) {
            PixelSpread corner{.middle = glm::dvec3(0)};
            corner.middle[k] = 1;
            const VertexVectors range =
                vertex_vectors(made, 0, corners_of(made.surfaces, 0), GetParam(), corner);
            const FloatVectors floats =
                in_floats(made, k, made.surfaces[static_cast<std::size_t>(k)], GetParam());
            const double light = glm::distance(middle(range.light.box), glm::dvec3(floats.light));
            const double half = glm::distance(middle(range.half.box), glm::dvec3(floats.half));
            ASSERT_LE(light, range.light.distance) << i << " " << k << " near " << near;
            ASSERT_LE(half, range.half.distance) << i << " " << k << " near " << near;
            if (k != 1) widths.push_back(range.half.distance);
        }
    }
    // A few dozen roundings, but where L and V all but cancel, or N and t.
    std::ranges::sort(widths);
    EXPECT_LT(widths[widths.size() / 2], 128 * 0x1p-24);
}

TEST_P(VertexVectorsOf, the_middle_is_the_mean_of_the_corners) {
    const Scene made = scene(1, 1, false);
    const auto range_at = [&](const glm::dvec3& weights) {
        return vertex_vectors(made, 0, corners_of(made.surfaces, 0), GetParam(),
                              {.middle = weights});
    };
    glm::dvec3 sum(0);
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 weights(0);
        weights[k] = 1;
        sum += middle(range_at(weights).light.box) / 3.0;
    }
    EXPECT_LT(glm::distance(middle(range_at(glm::dvec3(1.0 / 3)).light.box), sum), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Each, VertexVectorsOf,
                         testing::Values(VectorOrigin::at_vertices, VectorOrigin::unit_at_vertices),
                         [](const auto& origin) {
                             return std::string(origin.param == VectorOrigin::at_vertices
                                                    ? "as_long_as_they_are"
                                                    : "normalised");
                         });

} // namespace
} // namespace shadowproof
