#include "scenes/mesh/counted_casters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace shadowproof {
namespace {

/// A closed box around the origin, wound outwards, the light above it.
Scene box(float half) {
    Scene scene;
    scene.materials = {{"plain", false}};
    scene.lights.emplace_back();
    scene.lights[0].position = {0.1, 9, 0.2};
    for (unsigned i = 0; i < 8; ++i)
        scene.positions.emplace_back((i & 1U) != 0 ? half : -half, (i & 2U) != 0 ? half : -half,
                                     (i & 4U) != 0 ? half : -half);
    scene.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    scene.meshes = {{"box", 0, 12, 0}};
    return scene;
}

void turn_inside_out(Scene& scene) {
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.x, triangle.y);
}

std::size_t count(const std::vector<std::uint8_t>& flags) {
    return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), std::uint8_t{1}));
}

/// Appends a box to the last mesh, `aside` to the right.
void add_shell(Scene& scene, const Scene& other, float aside) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const glm::vec3& position : other.positions)
        scene.positions.push_back(position + glm::vec3(aside, 0, 0));
    for (const glm::uvec3& triangle : other.triangles) scene.triangles.push_back(triangle + first);
    scene.meshes.back().triangle_count += 12;
}

TEST(triangles_around_light, are_those_of_a_closed_shell_wound_outwards_that_holds_the_light) {
    Scene scene = box(1);
    EXPECT_EQ(count(triangles_around_light(scene)), 0U);
    scene.lights[0].position = {0.3, -0.2, 0.9};
    EXPECT_EQ(count(triangles_around_light(scene)), 12U);
    scene.lights[0].kind = Light::Kind::directional;
    EXPECT_EQ(count(triangles_around_light(scene)), 0U);
    scene.lights[0].kind = Light::Kind::spot;
    EXPECT_EQ(count(triangles_around_light(scene)), 12U);
    Scene room = scene;
    turn_inside_out(room); // its triangles face the light as they are
    EXPECT_EQ(count(triangles_around_light(room)), 0U);
    scene.triangles.pop_back(); // open
    --scene.meshes[0].triangle_count;
    EXPECT_EQ(count(triangles_around_light(scene)), 0U);
}

TEST(triangles_around_light, are_all_of_a_body_in_several_meshes_and_none_of_another_shell) {
    Scene scene = box(1);
    scene.lights[0].position = {0.3, -0.2, 0.9};
    scene.meshes = {{"half", 0, 5, 0}, {"other half", 5, 7, 0}};
    EXPECT_EQ(count(triangles_around_light(scene)), 12U);
    add_shell(scene, box(0.25F), 3); // a crate elsewhere, of the same mesh
    const std::vector<std::uint8_t> flags = triangles_around_light(scene);
    EXPECT_EQ(count(flags), 12U);
    EXPECT_EQ(std::count(flags.begin(), flags.begin() + 12, std::uint8_t{1}), 12);
    Scene room = box(9);
    turn_inside_out(room);
    add_shell(scene, room, 0); // around all of it: the windings are +1 and -1
    EXPECT_EQ(count(triangles_around_light(scene)), 12U);
}

TEST(triangles_around_light, may_have_it_on_a_face_an_edge_or_a_corner) {
    Scene scene = box(1);
    for (const glm::dvec3& place :
         {glm::dvec3(0.3, 1, 0.2), glm::dvec3(0.3, 1, 1), glm::dvec3(1, 1, 1)}) {
        scene.lights[0].position = place;
        EXPECT_EQ(count(triangles_around_light(scene)), 12U) << place.x << " " << place.z;
        scene.lights[0].position = place * 1.001;
        EXPECT_EQ(count(triangles_around_light(scene)), 0U) << place.x << " " << place.z;
    }
}

TEST(triangles_to_flip, are_those_averted_where_the_others_do_not_throw_every_shadow) {
    Scene scene = box(1);
    EXPECT_EQ(count(triangles_to_flip(scene)), 0U); // closed, outwards, the light outside
    Scene inside_out = scene;
    turn_inside_out(inside_out);
    EXPECT_EQ(count(triangles_to_flip(inside_out)), 2U); // the top
    Scene open = scene;
    open.triangles.pop_back();
    --open.meshes[0].triangle_count;
    EXPECT_EQ(count(triangles_to_flip(open)), 9U);
    open.meshes[0].casts = false;
    EXPECT_EQ(count(triangles_to_flip(open)), 0U);
    scene.lights[0].position = {0.3, -0.2, 0.9};
    EXPECT_EQ(count(triangles_to_flip(scene)), 12U); // the light inside
}

TEST(triangles_to_flip, are_told_shell_by_shell) {
    Scene scene = box(1);
    Scene other = box(0.25F);
    turn_inside_out(other);
    add_shell(scene, other, 3); // the mesh as a whole is closed, and its volume positive
    const std::vector<std::uint8_t> flags = triangles_to_flip(scene);
    EXPECT_EQ(count(flags), 4U); // of the small box the top, and the side towards the light
    EXPECT_EQ(std::count(flags.begin(), flags.begin() + 12, std::uint8_t{1}), 0);
}

TEST(counted_casters, turns_flagged_triangles_by_their_first_two_corners) {
    const Scene scene = box(1);
    std::vector<std::uint8_t> flipped(12, 0);
    flipped[3] = 1;
    const Scene casters = counted_casters(scene, {}, flipped);
    for (std::size_t i = 0; i < 12; ++i) {
        const glm::uvec3 as_given = scene.triangles[i];
        EXPECT_EQ(casters.triangles[i],
                  i == 3 ? glm::uvec3(as_given.y, as_given.x, as_given.z) : as_given);
    }
}

} // namespace
} // namespace shadowproof
