#include "scenes/load/catalog.h"
#include "scenes/relations/relation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

namespace shadowproof {
namespace {

Scene loaded(const char* name) {
    SceneRequest request;
    request.width = request.height = 32;
    return load_scene(name, request);
}

const Relation& relation_named(std::string_view name) {
    const auto found = std::ranges::find(relations(), name, &Relation::name);
    EXPECT_NE(found, relations().end()) << name;
    return *found;
}

ChangedScene changed(const char* relation, const Scene& scene) {
    auto result = relation_named(relation).change(scene);
    EXPECT_TRUE(result) << relation;
    return *std::move(result);
}

/// The corners of all triangles that are written down for each original one.
std::vector<glm::dvec3> corners_of(const Scene& scene, std::uint32_t triangle) {
    return {corner(scene, triangle, 0), corner(scene, triangle, 1), corner(scene, triangle, 2)};
}

glm::dvec3 area(const Scene& scene, std::uint32_t triangle) {
    const std::vector<glm::dvec3> c = corners_of(scene, triangle);
    return glm::cross(c[1] - c[0], c[2] - c[0]);
}

TEST(Relation, every_triangle_has_an_original_and_meshes_cover_all_of_them) {
    const Scene scene = loaded("ordinary");
    for (const Relation& relation : relations()) {
        const auto result = relation.change(scene);
        if (!result) continue;
        ASSERT_EQ(result->original.size(), result->scene.triangles.size()) << relation.name;
        std::set<std::uint32_t> originals(result->original.begin(), result->original.end());
        EXPECT_EQ(originals.size(), scene.triangles.size()) << relation.name;
        std::uint32_t next = 0;
        for (const Mesh& mesh : result->scene.meshes) {
            EXPECT_EQ(mesh.first_triangle, next) << relation.name;
            next += mesh.triangle_count;
        }
        EXPECT_EQ(next, result->scene.triangles.size()) << relation.name;
        for (std::uint32_t i = 0; i < result->scene.triangles.size(); ++i) {
            const Mesh& mesh = result->scene.meshes[mesh_of(result->scene, i)];
            const Mesh& original = scene.meshes[mesh_of(scene, result->original[i])];
            ASSERT_EQ(result->scene.materials[mesh.material].double_sided,
                      scene.materials[original.material].double_sided)
                << relation.name;
            ASSERT_EQ(mesh.casts, original.casts) << relation.name;
            ASSERT_EQ(mesh.receives, original.receives) << relation.name;
        }
    }
}

TEST(Relation, motions_keep_every_length_to_the_last_bit) {
    const Scene scene = loaded("near_plane");
    for (const char* name :
         {"moved", "turned_about_x", "turned_about_y", "turned_about_z", "mirrored"}) {
        const Scene other = changed(name, scene).scene;
        const bool mirrored = std::string_view(name) == "mirrored";
        for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                // A mirror exchanges two corners, which keeps the front in front.
                const int there = mirrored ? (3 - k) % 3 : k;
                const glm::dvec3 before = corner(scene, i, k) - scene.camera.eye;
                const glm::dvec3 after = corner(other, i, there) - other.camera.eye;
                glm::dvec3 sizes = glm::abs(before);
                glm::dvec3 moved_sizes = glm::abs(after);
                std::sort(&sizes.x, &sizes.x + 3);
                std::sort(&moved_sizes.x, &moved_sizes.x + 3);
                ASSERT_EQ(sizes, moved_sizes) << name << " triangle " << i << " corner " << k;
            }
    }
}

TEST(Relation, a_quarter_turn_keeps_handedness_and_four_of_them_change_nothing) {
    const Scene scene = loaded("ordinary");
    for (const char* name : {"turned_about_x", "turned_about_y", "turned_about_z"}) {
        Scene turned = changed(name, scene).scene;
        EXPECT_NE(turned.positions, scene.positions) << name;
        const Camera& camera = turned.camera;
        EXPECT_LT(glm::length(glm::cross(camera.right, camera.up) + camera.forward), 1e-12) << name;
        for (int i = 0; i < 3; ++i) turned = changed(name, turned).scene;
        EXPECT_EQ(turned.positions, scene.positions) << name;
        EXPECT_EQ(turned.camera.eye, scene.camera.eye) << name;
        EXPECT_EQ(turned.lights[0].position, scene.lights[0].position) << name;
    }
}

TEST(Relation, a_mirrored_scene_keeps_its_fronts_and_its_rays_are_mirrored) {
    const Scene scene = loaded("near_plane");
    const Scene mirrored = changed("mirrored", scene).scene;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        // Of a mirrored triangle wound as before, the area is mirrored like any direction.
        const glm::dvec3 normal = area(scene, i);
        const glm::dvec3 there = area(mirrored, i);
        ASSERT_LE(glm::length(there - glm::dvec3(-normal.x, normal.y, normal.z)),
                  1e-14 * glm::length(normal));
    }
    const glm::dvec3 ray = line_of_sight(scene.camera, 7.5, 3.5);
    EXPECT_EQ(line_of_sight(mirrored.camera, 7.5, 3.5), glm::dvec3(-ray.x, ray.y, ray.z));
}

TEST(Relation, what_is_moved_is_moved_exactly_or_not_at_all) {
    Scene scene = loaded("ordinary");
    const Scene moved = changed("moved", scene).scene;
    const glm::dvec3 offset = moved.camera.eye - scene.camera.eye;
    EXPECT_NE(offset, glm::dvec3(0, 0, 0));
    for (std::size_t i = 0; i < scene.positions.size(); ++i)
        ASSERT_EQ(glm::dvec3(moved.positions[i]) - offset, glm::dvec3(scene.positions[i]));
    // Last bits from 2^-40 up to 2^20 leave no room for an offset in 24 bits.
    for (glm::vec3& position : scene.positions)
        position = glm::vec3(0x1.23456p-17F) + 0x1.8p20F * position;
    scene.positions[0] = glm::vec3(0x1.fffffep-20F);
    scene.positions[1] = glm::vec3(0x1.fffffep20F);
    EXPECT_FALSE(relation_named("moved").change(scene));
}

TEST(Relation, scaling_leaves_out_what_would_become_a_denormal_or_infinite) {
    Scene scene = loaded("ordinary");
    EXPECT_EQ(changed("scaled", scene).scene.positions[5], scene.positions[5] * 1024.0F);
    scene.positions[0] = glm::vec3(0x1p120F);
    EXPECT_EQ(changed("scaled", scene).scene.positions[5], scene.positions[5] / 1024.0F);
    scene.positions[1] = glm::vec3(0x1p-120F);
    EXPECT_EQ(changed("scaled", scene).scene.positions[5], scene.positions[5] * 8.0F);
    scene.positions[0] = glm::vec3(0x1p127F);
    scene.positions[1] = glm::vec3(0x1p-126F);
    EXPECT_FALSE(relation_named("scaled").change(scene));
}

TEST(Relation, a_permuted_scene_has_the_same_triangles_in_another_order) {
    const Scene scene = loaded("near_plane");
    const ChangedScene result = changed("permuted", scene);
    EXPECT_NE(result.scene.triangles, scene.triangles);
    for (std::uint32_t i = 0; i < result.original.size(); ++i) {
        std::vector<glm::dvec3> written = corners_of(result.scene, i);
        const std::vector<glm::dvec3> original = corners_of(scene, result.original[i]);
        while (written[0] != original[0])
            std::rotate(written.begin(), written.begin() + 1, written.end());
        ASSERT_EQ(written, original);
    }
}

TEST(Relation, meshes_are_split_and_joined_again) {
    const Scene scene = loaded("ordinary");
    const Scene twice = changed("split", scene).scene;
    EXPECT_GT(twice.meshes.size(), scene.meshes.size());
    const Scene joined = changed("joined", twice).scene;
    EXPECT_LE(joined.meshes.size(), scene.meshes.size());
    EXPECT_EQ(joined.triangles, scene.triangles);
    EXPECT_FALSE(relation_named("joined").change(joined));
}

TEST(Relation, triangles_are_cut_in_four_that_fill_them_where_the_middles_are_floats) {
    Scene scene = loaded("near_plane");
    const ChangedScene result = changed("subdivided", scene);
    std::vector<glm::dvec3> areas(scene.triangles.size(), glm::dvec3(0, 0, 0));
    std::vector<int> pieces(scene.triangles.size(), 0);
    for (std::uint32_t i = 0; i < result.original.size(); ++i) {
        areas[result.original[i]] += area(result.scene, i);
        ++pieces[result.original[i]];
    }
    int cut = 0;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        ASSERT_TRUE(pieces[i] == 1 || pieces[i] == 4);
        cut += pieces[i] == 4 ? 1 : 0;
        EXPECT_LE(glm::length(areas[i] - area(scene, i)), 1e-12 * glm::length(area(scene, i)));
    }
    EXPECT_GT(cut, 0);
    for (glm::vec3& position : scene.positions) position = glm::vec3(1.0F);
    scene.positions[scene.triangles[0].x] = glm::vec3(0x1.000002p0F); // one step from all others
    EXPECT_EQ(std::ranges::count(changed("subdivided", scene).original, 0U), 1);
}

} // namespace
} // namespace shadowproof
