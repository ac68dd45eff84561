#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "scenes/load/catalog.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace shadowproof {
namespace {

/// The square from (0,0,0) to (1,1,0), seen from (0, 0, 4).
Scene square_scene() {
    Scene scene;
    scene.name = "square";
    scene.file = "square.gltf";
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    scene.triangles = {{0, 1, 2}, {2, 1, 3}};
    scene.materials.emplace_back();
    scene.meshes.push_back({.name = "sail", .first_triangle = 0, .triangle_count = 2});
    scene.lights.push_back({.name = "lamp", .position = {0, 5, 5}});
    scene.camera.eye = {0, 0, 4};
    return scene;
}

std::string refusal_after(const std::function<void(Scene&)>& change) {
    Scene scene = square_scene();
    change(scene);
    try {
        admit(scene);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

void expect_says(const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(Admission, a_coordinate_that_is_not_finite_or_too_large_is_refused_by_mesh_and_vertex) {
    for (const float bad :
         {NAN, INFINITY, -INFINITY, 3.4e38F, -1e20F, std::nextafter(0x1p62F, 1e30F)}) {
        const std::string message = refusal_after([&](Scene& s) { s.positions[2].y = bad; });
        expect_says(message, "square.gltf: ");
        expect_says(message, "mesh \"sail\": vertex 2");
    }
    EXPECT_EQ(refusal_after([](Scene& s) {
                  for (glm::vec3& position : s.positions) position *= 0x1p62F;
              }),
              "");
}

TEST(Admission, a_corner_that_doubles_cannot_hold_beside_the_others_is_refused_by_mesh_and_vertex) {
    // Half of the corners are at most 4 from the eye.
    const std::string message = refusal_after([](Scene& s) { s.positions[2].y = 0x1.000002p38F; });
    expect_says(message, "mesh \"sail\": vertex 2");
    expect_says(message, "6.87e+10 times as far from the camera");
    EXPECT_EQ(refusal_after([](Scene& s) { s.positions[2].y = 0x1p38F; }), "");
    // As near to the eye as floats hold no squares of.
    const auto near_eye = [](float distance) {
        return refusal_after([&](Scene& s) {
            s.camera.eye = {0, 0, 0};
            for (glm::vec3& position : s.positions) position += glm::vec3(0, 0, -4);
            s.positions[2] = {0, 0, -distance};
        });
    };
    expect_says(near_eye(0x1p-61F), "mesh \"sail\": vertex 2");
    expect_says(near_eye(0x1p-61F), "nearer to the camera than 2.17e-19");
    EXPECT_EQ(near_eye(0x1p-59F), "");
    EXPECT_EQ(near_eye(0), "");
    // All of them there: the scene is as large.
    EXPECT_EQ(refusal_after([](Scene& s) {
                  for (glm::vec3& position : s.positions) position *= 0x1p45F;
              }),
              "");
}

TEST(Admission, eyes_and_lights_at_numbers_whose_products_vanish_are_refused) {
    expect_says(refusal_after([](Scene& s) { s.camera.eye.x = 5e-324; }), "write 0");
    expect_says(refusal_after([](Scene& s) { s.lights[0].position.x = -1e-110; }),
                "the light \"lamp\" is at (-1e-110, 5, 5)");
    EXPECT_EQ(refusal_after([](Scene& s) { s.lights[0].position.x = 0x1p-340; }), "");
    const auto directional = [](double x) {
        return refusal_after([&](Scene& s) {
            s.lights[0] = {
                .name = "sun", .kind = Light::Kind::directional, .direction = {x, -1, 0}};
        });
    };
    expect_says(directional(5e-324), "the light \"sun\" points along (5e-324, -1, 0)");
    EXPECT_EQ(directional(1e-17), "");
}

TEST(Admission, the_vertex_is_numbered_within_its_mesh) {
    const std::string message = refusal_after([](Scene& s) {
        s.positions.insert(s.positions.end(), {{0, 0, 1}, {1, 0, 1}, {0, NAN, 1}});
        s.triangles.emplace_back(4, 5, 6);
        s.meshes.push_back({.name = "flag", .first_triangle = 2, .triangle_count = 1});
    });
    expect_says(message, "mesh \"flag\": vertex 2");
}

TEST(Admission, a_vertex_that_no_triangle_uses_is_nobodys_trouble) {
    EXPECT_EQ(refusal_after([](Scene& s) { s.positions.emplace_back(NAN, 0, 0); }), "");
}

TEST(Admission, the_camera_and_every_light_are_admitted_like_vertices) {
    expect_says(refusal_after([](Scene& s) { s.camera.eye.x = NAN; }), "the camera is at");
    expect_says(refusal_after([](Scene& s) { s.camera.eye.x = 1e19; }), "the camera is at");
    expect_says(refusal_after([](Scene& s) { s.camera.up.x = NAN; }), "the camera points");
    expect_says(refusal_after([](Scene& s) { s.camera.near = 1e-40; }), "near plane");
    expect_says(refusal_after([](Scene& s) { s.camera.near = NAN; }), "near plane");
    expect_says(refusal_after([](Scene& s) { s.camera.far = 1e39; }), "far plane");
    expect_says(refusal_after([](Scene& s) { s.camera.half_height = 1e-20; }), "field of view");
    expect_says(refusal_after([](Scene& s) { s.camera.half_height = 2.9e-7; }),
                "floats place nothing");
    EXPECT_EQ(refusal_after([](Scene& s) { s.camera.half_height = 3e-7; }), "");
    const auto narrow = [](Scene& s) {
        s.camera.half_height = 5e-7;
        s.camera.width = s.camera.height / 2;
    };
    expect_says(refusal_after(narrow), "floats place nothing");
    const auto second = [](const Light& light) {
        return refusal_after([&](Scene& s) { s.lights.push_back(light); });
    };
    expect_says(second({.name = "moon", .position = {0, 1e40, 0}}), "the light \"moon\" is at");
    expect_says(second({.name = "", .position = {0, NAN, 0}}), "the light is at");
    expect_says(second({.name = "sun", .kind = Light::Kind::directional, .direction = {0, NAN, 0}}),
                "the light \"sun\" points");
    EXPECT_EQ(second({.name = "far", .position = {0, 0x1p62, 0}}), "");
}

TEST(Admission, a_scene_of_ordinary_size_is_left_as_it_is) {
    for (const double size : {1.0, 1e-11, 1e11}) {
        Scene scene = square_scene();
        for (glm::vec3& position : scene.positions) position = glm::dvec3(position) * size;
        const Scene before = scene;
        admit(scene);
        EXPECT_EQ(scene.positions, before.positions);
        EXPECT_EQ(scene.camera.eye, before.camera.eye);
        EXPECT_EQ(scene.unit, 1);
        EXPECT_TRUE(scene.notes.empty());
    }
}

TEST(Admission, a_tiny_or_huge_scene_is_brought_to_unit_size_exactly) {
    for (const double size : {1e-40, 1e-25, 1e-20, 1e20, 1e25, 1e37}) {
        Scene scene = square_scene();
        for (glm::vec3& position : scene.positions) position = glm::dvec3(position) * size;
        scene.camera.eye *= size;
        scene.camera.near *= size;
        scene.lights[0].position *= size;
        const Scene before = scene;
        admit(scene);
        for (std::size_t i = 0; i < scene.positions.size(); ++i)
            EXPECT_EQ(glm::dvec3(scene.positions[i]) * scene.unit, glm::dvec3(before.positions[i]));
        EXPECT_EQ(scene.camera.eye * scene.unit, before.camera.eye);
        EXPECT_EQ(scene.camera.near * scene.unit, before.camera.near);
        EXPECT_EQ(scene.lights[0].position * scene.unit, before.lights[0].position);
        EXPECT_EQ(std::exp2(std::ilogb(scene.unit)), scene.unit);
        EXPECT_GE(scene.positions[1].x, 1);
        EXPECT_LT(scene.positions[1].x, 2);
        EXPECT_EQ(scene.notes.size(), 1U);
    }
}

TEST(Admission, light_that_falls_off_arrives_as_before_at_another_scale) {
    Scene scene = square_scene();
    for (glm::vec3& position : scene.positions) position *= 0x1p-70F;
    scene.camera.eye *= 0x1p-70;
    scene.camera.near *= 0x1p-70;
    scene.lights[0].position *= 0x1p-70;
    scene.inverse_square = true;
    admit(scene);
    EXPECT_EQ(scene.unit, 0x1p-70);
    EXPECT_EQ(scene.lights[0].intensity, 0x1p140);
}

TEST(Admission, a_scale_that_would_lose_bits_is_left_and_one_stray_vertex_decides_nothing) {
    // 1e-20 of a scene at 1e25 would be a denormal at unit size.
    EXPECT_NE(refusal_after([](Scene& s) {
                  for (glm::vec3& position : s.positions) position *= 1e25F;
                  s.positions[0].z = 1e-20F;
              }),
              "");
    Scene scene = square_scene();
    scene.positions[0].z = 1e-20F;
    scene.positions[2].z = 1e11F;
    admit(scene);
    EXPECT_EQ(scene.unit, 1);
}

TEST(Admission, numbers_of_lighting_that_leave_the_range_of_floats_are_refused_where_they_count) {
    const auto lit = [](Scene& s) {
        s.materials[0].name = "tin";
        s.materials[0].bump = Bump::normal_map;
        s.textures.emplace_back();
        s.materials[0].bump_map = 0;
        s.surfaces.resize(6);
    };
    const auto refusal = [&](const std::function<void(Scene&)>& change) {
        return refusal_after([&](Scene& s) {
            lit(s);
            change(s);
        });
    };
    EXPECT_EQ(refusal([](Scene&) {}), "");
    EXPECT_EQ(refusal([](Scene& s) { s.materials[0].bump_scale = -0x1p30; }), "");
    for (const double bad : {0x1.1p30, -1e27, 1.79e308, double{INFINITY}, double{NAN}}) {
        expect_says(refusal([&](Scene& s) { s.materials[0].bump_scale = bad; }),
                    "square.gltf: material \"tin\": a scale of bumps of ");
        expect_says(refusal([&](Scene& s) { s.ambient.z = bad; }), "an ambient light of ");
        expect_says(refusal([&](Scene& s) { s.materials[0].specular.y = bad; }),
                    "material \"tin\": a specular colour of ");
        expect_says(refusal([&](Scene& s) { s.lights[0].color.x = bad; }),
                    "light \"lamp\": a colour of ");
        // Nobody asks for the colour of a scene without bumps.
        EXPECT_EQ(refusal_after([&](Scene& s) { s.ambient.z = bad; }), "");
    }
}

/// Heights in units of space are over texels of any size.
TEST(Admission, slopes_that_leave_the_range_of_floats_are_refused) {
    const auto refusal = [&](double scale, double texels) {
        return refusal_after([&](Scene& s) {
            s.materials[0].name = "tin";
            s.materials[0].bump = Bump::height_field;
            s.materials[0].height_in_space = true;
            s.materials[0].bump_scale = scale;
            s.textures.emplace_back();
            s.textures[0].texels = Image<glm::vec4>(1, 1);
            s.materials[0].bump_map = 0;
            s.surfaces.resize(6);
            for (std::size_t i = 0; i < 6; ++i) {
                const glm::vec3 place = s.positions[s.triangles[i / 3][static_cast<int>(i % 3)]];
                s.surfaces[i].bump_at =
                    static_cast<float>(texels) * glm::vec2(place.x, place.y + place.z);
            }
        });
    };
    EXPECT_EQ(refusal(1, 1), "");
    EXPECT_EQ(refusal(1e6, 100), "");
    EXPECT_EQ(refusal(1e6, 0), ""); // no area in the texture: no slope
    expect_says(refusal(1e6, 1e6), "material \"tin\": on triangle 0 of the mesh ");
    expect_says(refusal(1e6, 1e6), "a slope of heights of ");
}

TEST(Admission, is_asked_of_every_file_that_is_loaded) {
    nlohmann::json gltf = test::triangle_gltf();
    gltf["nodes"][0]["translation"] = {0, 0, 1e20};
    gltf["nodes"][0]["name"] = "sail";
    const test::Folder folder;
    const std::filesystem::path file = folder.path() / "far.gltf";
    const std::string text = gltf.dump();
    test::write_bytes(file, test::FileBytes(text.begin(), text.end()));
    // Brought to unit size, the small one included: all of it lies 1e20 out.
    EXPECT_EQ(load_scene(file.string(), {}).unit, 0x1p66);
}

} // namespace
} // namespace shadowproof
