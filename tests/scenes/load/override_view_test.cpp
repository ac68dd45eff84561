// A view that is given beside the file: taken as it is, or refused by name.
#include "scenes/error.h"
#include "scenes/load/common/override_view.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof::test {
namespace {

Scene overridden(const ViewOverride& view, Light::Kind kind = Light::Kind::point) {
    Scene scene = load(triangle_gltf());
    scene.lights[0].kind = kind;
    override_view(view, scene);
    return scene;
}

std::string refused(const ViewOverride& view, Light::Kind kind = Light::Kind::point) {
    try {
        overridden(view, kind);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// Stands at (4, 5, 6) and looks along +x.
constexpr std::array<double, 16> sideways{0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 4, 5, 6, 1};

TEST(override_view, puts_camera_light_and_field_of_view_where_they_are_given) {
    const Scene scene = overridden(
        {.camera_matrix = sideways, .light_position = {{7, 8, 9}}, .vertical_field_of_view = 0.5});
    EXPECT_EQ(scene.camera.eye, glm::dvec3(4, 5, 6));
    EXPECT_EQ(scene.camera.forward, glm::dvec3(1, 0, 0));
    EXPECT_EQ(scene.camera.up, glm::dvec3(0, 1, 0));
    EXPECT_EQ(scene.camera.right, glm::dvec3(0, 0, 1));
    EXPECT_EQ(scene.camera.half_height, std::tan(0.25));
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(7, 8, 9));
    EXPECT_TRUE(says(scene, "--camera-matrix"));
    EXPECT_TRUE(says(scene, "--light-position"));
    EXPECT_TRUE(says(scene, "--fov"));
}

TEST(override_view, makes_the_camera_orthographic_and_then_has_no_field_of_view) {
    const Scene scene = overridden({.orthographic_height = 7});
    EXPECT_TRUE(scene.camera.is_orthographic());
    EXPECT_EQ(scene.camera.half_height, 3.5);
    EXPECT_TRUE(says(scene, "--ortho"));
    Scene again = scene;
    EXPECT_THROW(override_view({.vertical_field_of_view = 0.5}, again), Error);
}

TEST(override_view, leaves_what_is_not_given) {
    const Scene scene = overridden({});
    const Scene file = load(triangle_gltf());
    EXPECT_EQ(scene.camera.eye, file.camera.eye);
    EXPECT_EQ(scene.lights[0].position, file.lights[0].position);
    EXPECT_EQ(scene.notes, file.notes);
}

TEST(override_view, takes_a_scaled_matrix_and_one_of_floats) {
    std::array<double, 16> matrix = sideways;
    for (std::size_t i = 0; i < 12; ++i) matrix[i] *= 3;
    matrix[1] = 3e-6F; // floats' rounding
    EXPECT_EQ(refused({.camera_matrix = matrix}), "");
}

TEST(override_view, refuses_a_matrix_that_places_no_camera) {
    const auto changed = [](std::size_t place, double value) {
        std::array<double, 16> matrix = sideways;
        matrix[place] = value;
        return ViewOverride{.camera_matrix = matrix};
    };
    EXPECT_NE(refused(changed(3, 4)).find("transpose"), std::string::npos);
    EXPECT_NE(refused(changed(15, 2)).find("ends with 2"), std::string::npos);
    EXPECT_NE(refused(changed(2, 0)).find("no direction"), std::string::npos);
    EXPECT_NE(refused(changed(2, -1)).find("mirrors"), std::string::npos);
    EXPECT_NE(refused(changed(1, 0.01)).find("right angles"), std::string::npos);
}

TEST(override_view, refuses_to_place_a_light_that_has_only_a_direction) {
    const ViewOverride view{.light_position = {{7, 8, 9}}};
    EXPECT_NE(refused(view, Light::Kind::directional).find("directional"), std::string::npos);
    EXPECT_EQ(refused(view, Light::Kind::spot), "");
}

} // namespace
} // namespace shadowproof::test
