// Lines of sight, points on them, and the matrices that draw the same picture, of both projections.
#include "scenes/camera.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace shadowproof {
namespace {

Camera askew(Projection projection) {
    Camera camera{.projection = projection, .eye = {1, -2, 3}, .half_height = 0.7};
    camera.forward = glm::normalize(glm::dvec3(-0.3, 0.2, -1));
    camera.right = glm::normalize(glm::cross(camera.forward, glm::dvec3(0, 1, 0)));
    camera.up = glm::cross(camera.right, camera.forward);
    camera.near = 0.25;
    camera.far = 40;
    camera.width = 320;
    camera.height = 200;
    return camera;
}

class Cameras : public testing::TestWithParam<Projection> {};
INSTANTIATE_TEST_SUITE_P(Camera, Cameras,
                         testing::Values(Projection::perspective, Projection::orthographic));

constexpr std::array<glm::dvec2, 4> places{glm::dvec2(0, 0), glm::dvec2(160, 100),
                                           glm::dvec2(17.25, 181.5), glm::dvec2(319.5, 0.5)};

TEST_P(Cameras, project_every_point_of_a_line_of_sight_to_its_place_in_the_picture) {
    const Camera camera = askew(GetParam());
    for (const glm::dvec2& place : places) {
        const glm::dvec3 line = line_of_sight(camera, place.x, place.y);
        EXPECT_LT(glm::distance(place_of(camera, line), place), 1e-10);
        for (const double depth : {0.5, 3.0, 100.0}) {
            const glm::dvec3 point = point_on(camera, line, depth);
            EXPECT_NEAR(view_depth(camera, point), depth, 1e-12 * depth);
            EXPECT_LT(glm::distance(project(camera, point), place), 1e-9);
        }
    }
}

TEST_P(Cameras, draw_a_point_where_it_projects_and_planes_at_the_ends_of_window_depth) {
    const Camera camera = askew(GetParam());
    const glm::dmat4 standard = clip_from_view_finite(camera, 40) * view_from_world(camera);
    const glm::dmat4 reversed =
        clip_from_view_finite_reversed(camera, 40) * view_from_world(camera);
    for (const glm::dvec2& place : places)
        for (const double depth : {0.25, 7.0, 40.0}) {
            const glm::dvec3 point =
                point_on(camera, line_of_sight(camera, place.x, place.y), depth);
            const glm::dvec4 clip = standard * glm::dvec4(point, 1);
            const glm::dvec4 turned = reversed * glm::dvec4(point, 1);
            EXPECT_NEAR((clip.x / clip.w + 1) * 160, place.x, 1e-9);
            EXPECT_NEAR((1 - clip.y / clip.w) * 100, place.y, 1e-9);
            EXPECT_NEAR(turned.z / turned.w, 0.5 - 0.5 * clip.z / clip.w, 1e-12);
            if (depth == 7) continue;
            EXPECT_NEAR(clip.z / clip.w, depth == 40 ? 1 : -1, 1e-12);
        }
}

TEST_P(Cameras, see_a_triangle_from_the_side_that_its_lines_of_sight_meet) {
    const Camera camera = askew(GetParam());
    const glm::dvec4 eye = homogeneous_eye(camera);
    const glm::dvec3 point = point_on(camera, line_of_sight(camera, 200, 50), 5);
    const glm::dvec3 to_eye = glm::dvec3(eye) - eye.w * point;
    EXPECT_LT(glm::distance(glm::normalize(to_eye), way_to_eye(camera, point)), 1e-15);
}

TEST_P(Cameras, cover_as_many_pixels_with_a_length_as_it_projects_to) {
    const Camera camera = askew(GetParam());
    const glm::dvec3 point = point_on(camera, eye_line(camera), 5);
    const glm::dvec2 moved = project(camera, point + 0.125 * camera.up);
    EXPECT_NEAR(glm::distance(moved, project(camera, point)), 0.125 * pixels_of_length(camera, 5),
                1e-9);
}

TEST(Camera, that_is_orthographic_has_parallel_lines_of_sight_apart_by_its_own_units) {
    const Camera camera = askew(Projection::orthographic);
    const glm::dvec3 left = line_of_sight(camera, 0, 100);
    const glm::dvec3 right = line_of_sight(camera, 320, 100);
    EXPECT_LT(glm::distance(direction_of(camera, left), direction_of(camera, right)), 1e-15);
    EXPECT_NEAR(glm::distance(left, right), 2 * 0.7 * 320 / 200, 1e-12);
}

} // namespace
} // namespace shadowproof
