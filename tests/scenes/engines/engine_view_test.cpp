// Each engine's convention shows the same world point at the same pixel, and stands and looks where
// that engine's own rules say.
#include "scenes/camera.h"
#include "scenes/engines/engine_code.h"
#include "scenes/engines/engine_view.h"
#include "scenes/load/common/default_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <random>

namespace shadowproof::test {
namespace {

/// Random numbers from -1 to 1, the same in each run.
class Coordinates {
public:
    glm::dvec3 next() { return {one_(engine_), one_(engine_), one_(engine_)}; }

private:
    std::mt19937_64 engine_{20};
    std::uniform_real_distribution<double> one_{-1, 1};
};

Scene scene_seen_by(const glm::dvec3& eye, const glm::dvec3& forward, double far) {
    Scene scene;
    scene.camera.eye = eye;
    orient(scene.camera, forward, {0, 1, 0});
    scene.camera.half_height = 0.4;
    scene.camera.near = 0.25;
    scene.camera.far = far;
    scene.camera.width = 300;
    scene.camera.height = 200;
    scene.positions = {{0, 0, 0}, {3, -2, 40}};
    Light light;
    light.kind = Light::Kind::spot;
    light.position = {1, 2, 3};
    light.direction = glm::normalize(glm::dvec3(1, -2, 0.5));
    scene.lights = {light};
    return scene;
}

const double none = std::numeric_limits<double>::infinity();

glm::dvec4 clip_point(const EngineView& view, const glm::dvec3& point) {
    return view.clip_from_view * view.view_from_world * view.world_from_gltf * glm::dvec4(point, 1);
}

/// Pixels from the top left corner.
glm::dvec2 pixel_of(const Scene& scene, const EngineView& view, const glm::dvec3& point) {
    const glm::dvec4 clip = clip_point(view, point);
    return {(clip.x / clip.w + 1) / 2 * scene.camera.width,
            (1 - clip.y / clip.w) / 2 * scene.camera.height};
}

Scene in_parallel(Scene scene) {
    scene.camera.projection = Projection::orthographic;
    scene.camera.half_height = 3;
    return scene;
}

TEST(engine_view, every_convention_shows_a_point_at_the_same_pixel) {
    Coordinates coordinates;
    for (int i = 0; i < 50; ++i) {
        Scene scene =
            scene_seen_by(10.0 * coordinates.next(), coordinates.next(), i % 2 == 0 ? none : 80);
        if (i % 4 >= 2) scene = in_parallel(scene);
        const Camera& camera = scene.camera;
        const glm::dvec3 off = 0.5 * coordinates.next();
        const glm::dvec3 point =
            camera.eye + 6.0 * (camera.forward + off.x * camera.right + off.y * camera.up);
        const glm::dvec2 expected = project(camera, point);
        for (const Convention& convention : conventions())
            EXPECT_LT(glm::distance(pixel_of(scene, view_in(convention, scene), point), expected),
                      1e-9)
                << convention.name;
    }
}

TEST(engine_view, of_one_engine_shows_another_picture_in_another) {
    const Scene scene = scene_seen_by({1, 2, 9}, {-0.2, -0.3, -1}, none);
    EngineView mixed = view_in(conventions()[0], scene);
    const glm::dvec3 point{0.5, 0.5, 0};
    ASSERT_LT(glm::distance(pixel_of(scene, mixed, point), project(scene.camera, point)), 1e-9);
    for (const std::size_t mirrored : {1U, 3U, 5U, 6U}) { // Babylon, Blender, Unity, Unreal
        mixed.view_from_world = view_in(conventions()[mirrored], scene).view_from_world;
        EXPECT_GT(glm::distance(pixel_of(scene, mixed, point), project(scene.camera, point)), 1)
            << conventions()[mirrored].name;
    }
}

TEST(engine_view, depths_span_the_range_that_is_named) {
    for (const double far : {none, 80.0}) {
        const Scene scene = scene_seen_by({1, 2, 9}, {-0.2, -0.3, -1}, far);
        const Camera& camera = scene.camera;
        const auto depth = [&](const EngineView& view, double at) {
            const glm::dvec4 clip = clip_point(view, camera.eye + at * camera.forward);
            return clip.z / clip.w;
        };
        for (const Convention& convention : conventions()) {
            const EngineView view = view_in(convention, scene);
            const bool reversed = convention.depth_range == NdcDepth::one_to_zero;
            EXPECT_NEAR(depth(view, camera.near), reversed ? 1 : -1, 1e-9) << convention.name;
            const double last = view.far ? *view.far / convention.units : 1e12;
            EXPECT_NEAR(depth(view, last), reversed ? 0 : 1, 1e-9) << convention.name;
            EXPECT_EQ(view.far_is_made_up, std::isinf(far) && view.far.has_value());
        }
    }
}

TEST(engine_view, of_an_orthographic_camera_depth_is_linear_and_its_extent_is_the_engines) {
    const Scene scene = in_parallel(scene_seen_by({1, 2, 9}, {-0.2, -0.3, -1}, 80));
    const Camera& camera = scene.camera;
    for (const Convention& convention : conventions()) {
        const EngineView view = view_in(convention, scene);
        const auto depth = [&](double at) {
            const glm::dvec4 clip = clip_point(view, camera.eye + at * camera.forward);
            return clip.z / clip.w;
        };
        ASSERT_TRUE(view.extent);
        EXPECT_EQ(*view.extent, convention.units * glm::dvec2(9, 6));
        EXPECT_NEAR(depth(0.5 * (camera.near + 80)), 0.5 * (depth(camera.near) + depth(80)), 1e-12);
        EXPECT_NEAR(depth(80), convention.depth_range == NdcDepth::one_to_zero ? 0 : 1, 1e-12);
        std::string code;
        for (const std::string& line : engine_code(convention, scene, view)) code += line;
        EXPECT_TRUE(code.find("rtho") != std::string::npos ||
                    code.find("ORTHO") != std::string::npos)
            << code;
    }
}

TEST(engine_view, a_far_plane_that_is_made_up_cuts_no_vertex) {
    const Scene scene = scene_seen_by({0, 0, -10}, {0, 0, 1}, none);
    const EngineView view = view_in(conventions()[0], scene);
    ASSERT_TRUE(view.far_is_made_up);
    EXPECT_EQ(*view.far, 100); // the farthest vertex is 50 deep
}

/// What a node of each engine looks along, and its up: as their manuals have it.
const std::map<std::string_view, std::pair<glm::dvec3, glm::dvec3>> looks{
    {"three", {{0, 0, -1}, {0, 1, 0}}}, {"babylon", {{0, 0, 1}, {0, 1, 0}}},
    {"godot", {{0, 0, -1}, {0, 1, 0}}}, {"blender", {{0, 0, -1}, {0, 1, 0}}},
    {"ogre", {{0, 0, -1}, {0, 1, 0}}},  {"unity", {{0, 0, 1}, {0, 1, 0}}},
    {"unreal", {{1, 0, 0}, {0, 0, 1}}},
};

TEST(engine_view, a_node_that_is_turned_as_told_looks_where_the_camera_looks) {
    Coordinates coordinates;
    for (int i = 0; i < 50; ++i) {
        const Scene scene = scene_seen_by(coordinates.next(), coordinates.next(), none);
        for (const Convention& convention : conventions()) {
            const EngineView view = view_in(convention, scene);
            const auto& [forward, up] = looks.at(convention.name);
            const glm::dmat3 world(view.world_from_gltf);
            const auto near = [&](const glm::dvec3& turned, const glm::dvec3& wanted) {
                return glm::distance(turned, glm::normalize(world * wanted)) < 1e-12;
            };
            EXPECT_TRUE(near(view.rotation * forward, scene.camera.forward)) << convention.name;
            EXPECT_TRUE(near(view.rotation * up, scene.camera.up)) << convention.name;
            EXPECT_TRUE(near(view.light_rotation * forward, scene.lights[0].direction))
                << convention.name;
            EXPECT_NEAR(glm::determinant(glm::dmat3(view.world_from_camera)), 1, 1e-12);
        }
    }
}

TEST(engine_view, fields_of_view_give_the_scales_of_the_projection) {
    const Scene scene = scene_seen_by({1, 2, 9}, {-0.2, -0.3, -1}, none);
    for (const Convention& convention : conventions()) {
        const EngineView view = view_in(convention, scene);
        // The angle that the engine takes, and the aspect, as its own projection is made of them.
        const double across = convention.horizontal_field_of_view
                                  ? 1 / std::tan(view.horizontal_field_of_view / 2)
                                  : 1 / std::tan(view.vertical_field_of_view / 2) / 1.5;
        const glm::dmat4 clip = view.clip_from_view;
        EXPECT_NEAR(glm::length(glm::dvec3(clip[0][0], clip[1][0], clip[2][0])), across, 1e-12);
        EXPECT_NEAR(glm::length(glm::dvec3(clip[0][1], clip[1][1], clip[2][1])), across * 1.5,
                    1e-12);
    }
}

TEST(engine_view, stands_where_a_hand_computes_it) {
    const Scene scene = scene_seen_by({1, 2, 3}, {0, 0, -1}, none);
    const auto at = [&](std::size_t engine) { return view_in(conventions()[engine], scene); };
    EXPECT_EQ(at(0).position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(at(1).position, glm::dvec3(-1, 2, 3));
    EXPECT_EQ(at(3).position, glm::dvec3(1, -3, 2));
    EXPECT_EQ(at(5).position, glm::dvec3(-1, 2, 3));
    EXPECT_EQ(at(6).position, glm::dvec3(100, 300, 200));
    EXPECT_EQ(at(6).near, 25);
    // Unreal's -y is glTF's -z.
    const glm::dvec3 rotator = unreal_rotator(at(6).rotation);
    EXPECT_NEAR(rotator.x, 0, 1e-12);
    EXPECT_NEAR(rotator.y, -90, 1e-12);
    EXPECT_NEAR(rotator.z, 0, 1e-12);
}

/// FRotationMatrix: its rows are where x, y and z go.
glm::dmat3 unreal_axes(const glm::dvec3& degrees) {
    const glm::dvec3 s = glm::sin(glm::radians(degrees));
    const glm::dvec3 c = glm::cos(glm::radians(degrees));
    return {{c.x * c.y, c.x * s.y, s.x},
            {s.z * s.x * c.y - c.z * s.y, s.z * s.x * s.y + c.z * c.y, -s.z * c.x},
            {-(c.z * s.x * c.y + s.z * s.y), c.y * s.z - c.z * s.x * s.y, c.z * c.x}};
}

TEST(engine_view, pitch_yaw_and_roll_turn_as_unreal_turns_by_them) {
    Coordinates coordinates;
    const auto expect_same = [](const glm::dquat& rotation) {
        const glm::dmat3 wanted = glm::mat3_cast(rotation);
        const glm::dmat3 turned = unreal_axes(unreal_rotator(rotation));
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_LT(glm::distance(turned[axis], wanted[axis]), 1e-7) << axis;
    };
    for (int i = 0; i < 100; ++i)
        expect_same(glm::normalize(glm::dquat(1, coordinates.next()) +
                                   glm::dquat(coordinates.next().x, 0, 0, 0)));
    const double half = std::sqrt(0.5);
    expect_same({half, 0, -half, 0}); // straight up
    expect_same({half, 0, half, 0});  // straight down
}

} // namespace
} // namespace shadowproof::test
