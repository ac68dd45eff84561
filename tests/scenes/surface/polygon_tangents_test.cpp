// Tangents polygon by polygon: along the rows of each triangle's own picture.
#include "scenes/load/catalog.h"
#include "scenes/surface/polygon_tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace shadowproof {
namespace {

/// Triangles with corners of their own, and a bump map.
struct Corner {
    glm::vec3 position;
    glm::vec2 at;
};
Scene scene_of(const std::vector<Corner>& corners) {
    Scene scene;
    for (const Corner& corner : corners) {
        const auto number = static_cast<unsigned>(scene.positions.size());
        if (number % 3 == 0) scene.triangles.emplace_back(number, number + 1, number + 2);
        scene.positions.push_back(corner.position);
        scene.surfaces.push_back(
            {.normal = {0, 0, 1}, .tangent = {0, 1, 0, -1}, .bump_at = corner.at});
    }
    scene.materials = {{.name = "bumpy", .bump = Bump::normal_map}, {.name = "smooth"}};
    scene.meshes.push_back(
        {.name = "bumpy", .triangle_count = static_cast<std::uint32_t>(scene.triangles.size())});
    return scene;
}

TEST(PolygonTangents, run_along_the_rows_and_keep_the_hand) {
    const Scene scene = scene_of({{{0, 0, 0}, {0, 0}},
                                  {{2, 0, 0}, {1, 0}},
                                  {{0, 2, 0}, {0, -1}},
                                  // The same, its picture turned by a quarter, and mirrored.
                                  {{0, 0, 0}, {0, 0}},
                                  {{2, 0, 0}, {0, 1}},
                                  {{0, 2, 0}, {1, 0}}});
    const std::vector<Surface> made = surfaces_with_polygon_tangents(scene);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(made[k].tangent, glm::vec4(1, 0, 0, -1));
        EXPECT_EQ(made[3 + k].tangent, glm::vec4(0, 1, 0, -1));
        EXPECT_EQ(made[k].normal, scene.surfaces[k].normal);
        EXPECT_EQ(made[k].bump_at, scene.surfaces[k].bump_at);
    }
}

TEST(PolygonTangents, of_triangles_without_area_or_bumps_stay_the_vertices_own) {
    Scene scene = scene_of({{{0, 0, 0}, {0, 0}},
                            {{2, 0, 0}, {1, 1}},
                            {{0, 2, 0}, {2, 2}},
                            {{0, 0, 0}, {0, 0}},
                            {{0, 0, 0}, {1, 0}},
                            {{0, 2, 0}, {0, 1}},
                            {{0, 0, 0}, {0, 0}},
                            {{2, 0, 0}, {1, 0}},
                            {{0, 2, 0}, {0, 1}}});
    for (std::size_t k = 6; k < 9; ++k) scene.surfaces[k].tangent = glm::vec4(0);
    scene.meshes[0].triangle_count = 2;
    scene.meshes.push_back(
        {.name = "smooth", .first_triangle = 2, .triangle_count = 1, .material = 1});
    const std::vector<Surface> made = surfaces_with_polygon_tangents(scene);
    for (std::size_t k = 0; k < made.size(); ++k)
        EXPECT_EQ(made[k].tangent, scene.surfaces[k].tangent) << k;
}

/// The capsule of coarse_curve has six sides: a side's own tangent is half the angle between two of
/// them off what is averaged at its corners.
TEST(PolygonTangents, of_a_capsule_of_six_sides_are_30_degrees_off_those_averaged_at_its_vertices) {
    const Scene scene = load_scene("coarse_curve", {});
    const std::vector<Surface> made = surfaces_with_polygon_tangents(scene);
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
        const glm::vec3 averaged(scene.surfaces[i].tangent);
        if (averaged == glm::vec3(0)) continue;
        const double cosine = glm::dot(averaged, glm::vec3(made[i].tangent));
        EXPECT_NEAR(glm::length(glm::vec3(made[i].tangent)), 1, 1e-6);
        sum += cosine;
        ++count;
    }
    EXPECT_GT(count, 100);
    EXPECT_NEAR(sum / count, std::sqrt(0.75), 1e-3);
}

} // namespace
} // namespace shadowproof
