#include "scenes/error.h"
#include "scenes/load/catalog.h"
#include "scenes/mesh/topology.h"
#include "scenes/stress/parameter.h"
#include "scenes/stress/place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

Scene loaded(const char* name) {
    SceneRequest request;
    request.width = 64;
    request.height = 48;
    return load_scene(name, request);
}

/// A closed box over a floor that shows shadows, with short coordinates: sums and quarters of them
/// are exact. The light is over the box, the eye beside it.
Scene box_over_floor() {
    Scene scene;
    scene.name = "box over floor";
    for (const float y : {1.0F, 2.0F})
        for (const auto& [x, z] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}})
            scene.positions.emplace_back(x, y, z);
    scene.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                       {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    scene.meshes.push_back({.name = "box", .first_triangle = 0, .triangle_count = 12});
    for (const auto& [x, z] : {std::pair{-8, -8}, {-8, 8}, {8, 8}, {8, -8}})
        scene.positions.emplace_back(x, 0, z);
    scene.triangles.emplace_back(8, 9, 10);
    scene.triangles.emplace_back(8, 10, 11);
    scene.meshes.push_back({.name = "floor", .first_triangle = 12, .triangle_count = 2});
    scene.materials.push_back({.name = "plain"});
    scene.lights.push_back({.name = "light", .position = {0.5, 6, 0.25}});
    scene.camera.eye = {0, 3, 8};
    scene.camera.width = scene.camera.height = 64;
    return scene;
}

/// How many triangles' planes hold a point exactly.
int planes_through(const Scene& scene, const glm::dvec3& point) {
    int planes = 0;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
        planes += side(scene, i, {point, 1}) == 0 ? 1 : 0;
    return planes;
}

double area_of(const Scene& scene) {
    double area = 0;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
        area += 0.5 * glm::length(glm::cross(corner(scene, i, 1) - corner(scene, i, 0),
                                             corner(scene, i, 2) - corner(scene, i, 0)));
    return area;
}

void expect_meshes_cover_all(const Scene& scene) {
    std::uint32_t next = 0;
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_EQ(mesh.first_triangle, next);
        next += mesh.triangle_count;
    }
    EXPECT_EQ(next, scene.triangles.size());
}

void expect_refused(const Scene& scene, const Stress& stress, const std::string& words) {
    try {
        stressed(scene, stress);
        ADD_FAILURE() << words_of(stress) << " was taken";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(StressParameters, ladders_lead_from_the_scenes_own_value_to_the_end) {
    for (const char* name : {"ordinary", "bumpy_torus", "sun"}) {
        const Scene scene = loaded(name);
        for (const StressParameter& parameter : stress_parameters()) {
            SCOPED_TRACE(std::string(name) + " " + std::string(parameter.name));
            ASSERT_TRUE(parameter.low || parameter.high);
            if (!parameter.suits(scene)) continue;
            const double own = parameter.own(scene);
            EXPECT_GT(own, 0);
            for (const bool up : {false, true}) {
                const std::vector<double> values = ladder(parameter, scene, up);
                double before = own;
                for (const double value : values) {
                    EXPECT_TRUE(up ? value > before : value < before) << value;
                    before = value;
                }
                if (values.empty()) continue;
                const double end = up ? *parameter.high : *parameter.low;
                EXPECT_EQ(values.back(), !up && parameter.down_to_zero ? 0 : end);
            }
        }
    }
}

TEST(StressParameters, every_value_of_every_ladder_is_taken_or_refused_with_a_reason) {
    for (const char* name : {"ordinary", "bumpy_torus", "sun", "spot"}) {
        const Scene scene = loaded(name);
        for (const StressParameter& parameter : stress_parameters()) {
            if (!parameter.suits(scene)) continue;
            for (const bool up : {false, true})
                for (const double value : ladder(parameter, scene, up)) {
                    const Stress stress{std::string(parameter.name), value};
                    SCOPED_TRACE(std::string(name) + " " + words_of(stress));
                    try {
                        expect_meshes_cover_all(stressed(scene, stress));
                    } catch (const Error& error) {
                        EXPECT_FALSE(std::string(error.what()).empty());
                    }
                }
        }
    }
}

TEST(StressParameters, the_light_is_put_onto_face_edge_and_vertex_exactly) {
    const Scene scene = box_over_floor();
    const Scene on_face = stressed(scene, {"light_to_face", 0});
    EXPECT_EQ(chosen_light(on_face).position.y, 2);
    EXPECT_EQ(planes_through(on_face, chosen_light(on_face).position), 2); // the top has two
    const Scene on_edge = stressed(scene, {"light_to_edge", 0});
    EXPECT_EQ(planes_through(on_edge, chosen_light(on_edge).position), 2); // the top's diagonal
    const Scene on_vertex = stressed(scene, {"light_to_vertex", 0});
    EXPECT_EQ(chosen_light(on_vertex).position, glm::dvec3(1, 2, 1));
    EXPECT_EQ(planes_through(on_vertex, chosen_light(on_vertex).position), 6);
}

TEST(StressParameters, the_light_comes_as_near_as_is_asked) {
    const Scene scene = box_over_floor();
    const double diagonal = diagonal_of(scene, scene.meshes[0]);
    EXPECT_NEAR(diagonal, 3, 1e-12);
    const Scene near = stressed(scene, {"light_to_vertex", 1e-3});
    EXPECT_NEAR(glm::distance(chosen_light(near).position, {1, 2, 1}), 3e-3, 1e-12);
    const Scene far = stressed(scene, {"light_to_face", 1e6});
    EXPECT_NEAR(glm::length(chosen_light(far).position), 3e6, 10);
}

TEST(StressParameters, the_light_grazes_the_receiver_at_the_angle_asked_for) {
    const Scene scene = box_over_floor();
    const std::uint32_t receiver = *main_receiver(scene);
    EXPECT_GE(receiver, 12U); // the floor
    const Scene grazing = stressed(scene, {"light_elevation", 1e-3});
    const glm::dvec3 middle = 0.25 * corner(scene, receiver, 0) +
                              0.25 * corner(scene, receiver, 1) + 0.5 * corner(scene, receiver, 2);
    const glm::dvec3 to_light = chosen_light(grazing).position - middle;
    EXPECT_NEAR(std::asin(to_light.y / glm::length(to_light)), 1e-3, 1e-9);
    EXPECT_NEAR(glm::length(to_light), glm::distance(chosen_light(scene).position, middle), 1e-9);
    const Scene level = stressed(scene, {"light_elevation", 0});
    EXPECT_EQ(side(level, receiver, {chosen_light(level).position, 1}), 0);
}

TEST(StressParameters, a_light_at_infinity_is_directional) {
    const Scene scene = box_over_floor();
    const Scene far = stressed(scene, {"light_w", 1e-9});
    const Scene infinite = stressed(scene, {"light_w", 0});
    EXPECT_EQ(chosen_light(infinite).kind, Light::Kind::directional);
    EXPECT_NEAR(
        glm::length(chosen_light(infinite).direction + glm::normalize(chosen_light(far).position)),
        0, 1e-8);
}

TEST(StressParameters, the_eye_is_put_onto_a_side_exactly) {
    const Scene scene = box_over_floor();
    const Scene on_side = stressed(scene, {"eye_to_side", 0});
    const glm::dvec3 eye = on_side.camera.eye;
    const glm::dvec3 light = chosen_light(scene).position;
    int sides = 0;
    for (std::uint32_t i = 0; i < 12; ++i)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 a = corner(scene, i, k);
            const glm::dvec3 b = corner(scene, i, (k + 1) % 3);
            sides += glm::dot(glm::cross(b - a, light - a), eye - a) == 0 ? 1 : 0;
        }
    EXPECT_GE(sides, 2); // both directions of the edge
    EXPECT_LT(eye.y, 2);
    EXPECT_NEAR(glm::length(on_side.camera.forward), 1, 1e-12);
    EXPECT_NEAR(glm::dot(on_side.camera.forward, on_side.camera.right), 0, 1e-12);
}

TEST(StressParameters, slivers_cover_what_their_triangle_covered) {
    const Scene scene = box_over_floor();
    const Scene split = stressed(scene, {"sliver_aspect", 1e4});
    EXPECT_EQ(split.triangles.size(), 3 * scene.triangles.size());
    expect_meshes_cover_all(split);
    EXPECT_NEAR(area_of(split), area_of(scene), 1e-4 * area_of(scene));
    // The box's first face: its longest edge is the diagonal, of length sqrt(8).
    const glm::dvec3 a = corner(split, 0, 0);
    const glm::dvec3 b = corner(split, 0, 1);
    const glm::dvec3 c = corner(split, 0, 2);
    const double height = glm::length(glm::cross(b - a, c - a)) / glm::distance(a, b);
    EXPECT_NEAR(glm::distance(a, b) / height, 1e4, 10);
}

TEST(StressParameters, small_triangles_are_as_small_as_asked_and_leave_no_gaps) {
    const Scene scene = box_over_floor();
    const Scene split = stressed(scene, {"triangle_size", 0.01});
    EXPECT_EQ(split.triangles.size(), 7 * scene.triangles.size());
    expect_meshes_cover_all(split);
    EXPECT_NEAR(area_of(split), area_of(scene), 1e-5 * area_of(scene));
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const std::uint32_t small = 7 * i; // the others are around it
        const double pixel = 2 * scene.camera.half_height *
                             glm::distance(corner(split, small, 0), scene.camera.eye) /
                             scene.camera.height;
        double longest = 0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(
                longest, glm::distance(corner(split, small, k), corner(split, small, (k + 1) % 3)));
        EXPECT_NEAR(longest / pixel, 0.01, 1e-4);
    }
    const std::vector<std::uint32_t> box = triangles_of(split.meshes[0]);
    EXPECT_TRUE(boundary(split, weld_by_position(split.positions), box).empty());
}

TEST(StressParameters, a_receiver_grows_in_its_plane_and_nothing_else_does) {
    const Scene scene = box_over_floor();
    const Scene large = stressed(scene, {"receiver_size", 1e4});
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(large.positions[i], scene.positions[i]);
    for (std::size_t i = 8; i < 12; ++i) EXPECT_EQ(large.positions[i].y, 0);
    const double height = 2 * scene.camera.half_height * size_of(scene); // of the picture
    EXPECT_NEAR(glm::distance(large.positions[8], large.positions[10]) / height, 1e4, 1);
}

TEST(StressParameters, a_light_comes_down_to_the_receivers_plane) {
    const Scene scene = box_over_floor();
    const Scene level = stressed(scene, {"light_to_plane", 0});
    EXPECT_EQ(chosen_light(level).position, glm::dvec3(0.5, 0, 0.25));
    const Scene above = stressed(scene, {"light_to_plane", 1e-3});
    EXPECT_NEAR(chosen_light(above).position.y, 1e-3 * size_of(scene), 1e-15);
}

TEST(StressParameters, faces_and_casters_are_repeated_as_often_as_asked) {
    const Scene scene = box_over_floor();
    EXPECT_EQ(stressed(scene, {"coincident_faces", 5}).triangles.size(),
              5 * scene.triangles.size());
    const Scene nested = stressed(scene, {"nested_volumes", 10});
    EXPECT_EQ(nested.triangles.size(), 120U + 2);
    expect_meshes_cover_all(nested);
    for (const glm::vec3& position : nested.positions) EXPECT_LT(position.y, 6);
}

TEST(StressParameters, lengths_and_places_are_taken_along) {
    const Scene scene = box_over_floor();
    const Scene larger = stressed(scene, {"scale", 1024});
    for (std::size_t i = 0; i < scene.positions.size(); ++i)
        EXPECT_EQ(larger.positions[i], 1024.0F * scene.positions[i]);
    EXPECT_EQ(larger.camera.near, 1024 * scene.camera.near);
    EXPECT_EQ(chosen_light(larger).position, 1024.0 * chosen_light(scene).position);
    const Scene away = stressed(scene, {"origin_distance", 1e3});
    EXPECT_NEAR(glm::distance(away.camera.eye, scene.camera.eye), 1e3 * size_of(scene), 1e-6);
    EXPECT_NEAR(glm::distance(away.camera.eye, chosen_light(away).position),
                glm::distance(scene.camera.eye, chosen_light(scene).position), 1e-6);
}

TEST(StressParameters, views_change_as_asked) {
    const Scene scene = box_over_floor();
    const Scene wide = stressed(scene, {"aspect", 16});
    EXPECT_EQ(wide.camera.width, 256);
    EXPECT_EQ(wide.camera.height, 16);
    EXPECT_NEAR(stressed(scene, {"field_of_view", 90}).camera.half_height, 1, 1e-12);
    EXPECT_NEAR(stressed(scene, {"near_plane", 1e-5}).camera.near, 1e-5 * size_of(scene), 1e-15);
    EXPECT_TRUE(std::isinf(stressed(scene, {"near_over_far", 0}).camera.far));
    const Scene closer = stressed(scene, {"eye_distance", 0.5});
    EXPECT_NEAR(closer.camera.eye.z, 8 - 0.5 * size_of(scene), 1e-12);
}

TEST(StressParameters, of_an_orthographic_view_keep_its_picture_and_ask_for_no_field_of_view) {
    Scene scene = box_over_floor();
    scene.camera.projection = Projection::orthographic;
    scene.camera.half_height = 3;
    scene.camera.near = 0;
    const Scene larger = stressed(scene, {"scale", 1024});
    for (const glm::dvec3 position : {scene.positions[0], scene.positions[9]})
        EXPECT_LT(glm::distance(project(larger.camera, 1024.0 * position),
                                project(scene.camera, position)),
                  1e-9);
    for (const char* name : {"field_of_view", "eye_distance", "eye_to_side", "near_plane"})
        expect_refused(scene, {name, 0.5}, "does not suit");
}

TEST(StressParameters, what_cannot_be_is_refused_with_the_reason) {
    const Scene scene = box_over_floor();
    expect_refused(scene, {"wind", 1}, "no such parameter");
    expect_refused(scene, {"near_plane", 2}, "out of range");
    expect_refused(scene, {"light_to_face", 1e-300}, "out of range");
    expect_refused(scene, {"coincident_faces", 1.5}, "out of range");
    expect_refused(scene, {"bump_slope", 2}, "does not suit");
    Scene cut = scene;
    cut.camera.far = 9;
    expect_refused(cut, {"near_plane", 1}, "near plane");
}

TEST(StressParameters, declarations_of_the_file_are_of_the_scene_as_it_was) {
    const Scene scene = loaded("near_plane");
    ASSERT_FALSE(scene.provokes.empty());
    EXPECT_FALSE(stressed(scene, {"scale", 2}).declares_provokes);
}

} // namespace
} // namespace shadowproof
