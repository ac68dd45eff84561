#include "scenes/bundled/author/stages.h"
#include "scenes/catalog.h"
#include "scenes/error.h"
#include "scenes/topology.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {
namespace {

TEST(bundled, the_author_writes_the_bytes_that_are_checked_in) {
    const std::vector<author::Stage> stages = author::all_stages();
    ASSERT_EQ(stages.size(), bundled_scenes().size());
    for (std::size_t i = 0; i < stages.size(); ++i) {
        EXPECT_EQ(stages[i].name, bundled_scenes()[i].name);
        const auto bytes = test::bytes_of(bundled_folder() / (stages[i].name + ".gltf"));
        EXPECT_TRUE(std::string(bytes.begin(), bytes.end()) == write_gltf(stages[i]))
            << stages[i].name << ": run shadowproof_author scenes/bundled";
    }
}

TEST(bundled, an_unknown_name_is_answered_with_the_known_ones) {
    try {
        load_scene("no_such_scene", {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("ordinary, near_plane, far_plane, eye_inside"),
                  std::string::npos);
    }
}

/// A light-facing or averted triangle, for a tracer in plain double that owes nothing to the
/// reference.
struct Face {
    glm::dvec3 a, ab, ac, normal;
    bool faces_light = false;
};

std::vector<Face> faces_of(const Scene& scene) {
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        Face face;
        face.a = corner(scene, i, 0);
        face.ab = corner(scene, i, 1) - face.a;
        face.ac = corner(scene, i, 2) - face.a;
        face.normal = glm::cross(face.ab, face.ac);
        face.faces_light = glm::dot(face.normal, chosen_light(scene).position - face.a) > 0;
        faces.push_back(face);
    }
    return faces;
}

/// Parameter along origin + t * direction, or a negative one where there is no hit.
double hit(const Face& face, const glm::dvec3& origin, const glm::dvec3& direction) {
    const double det = -glm::dot(face.normal, direction);
    const glm::dvec3 across = glm::cross(origin - face.a, direction);
    const double u = glm::dot(face.ac, across) / det;
    const double v = -glm::dot(face.ab, across) / det;
    return u >= 0 && v >= 0 && u + v <= 1 ? glm::dot(face.normal, origin - face.a) / det : -1;
}

int shadow_depth(const std::vector<Face>& faces, const glm::dvec3& point, const glm::dvec3& light,
                 double from = 0) {
    int depth = 0;
    for (const Face& face : faces) {
        if (!face.faces_light) continue;
        const double t = hit(face, point, light - point);
        depth += t > from && t < 1 ? 1 : 0;
    }
    return depth;
}

/// Rays of a 64 by 64 grid, and among them those whose ...
struct Census {
    int near_inside = 0; ///< point on the near plane is in a volume
    int far_inside = 0;  ///< point on the far plane is in a volume
    int lit = 0;         ///< surface is lit
    int shadowed = 0;
    int lit_before_far_inside = 0; ///< surface is lit and the far point in a volume
    int deepest = 0;               ///< largest shadow depth anywhere looked at
    int eye_depth = 0;
    bool near_as_eye = true; ///< every near point is as deep as the eye
};

constexpr int grid = 64;

Census take_census(const Scene& scene) {
    const std::vector<Face> faces = faces_of(scene);
    const Camera& camera = scene.camera;
    const glm::dvec3 light = chosen_light(scene).position;
    Census census;
    census.eye_depth = shadow_depth(faces, camera.eye, light);
    for (int i = 0; i < grid * grid; ++i) {
        const glm::dvec3 ray = ray_direction(camera, (i % grid + 0.5) * camera.width / grid,
                                             (i / grid + 0.5) * camera.height / grid);
        const int near = shadow_depth(faces, camera.eye + camera.near * ray, light);
        const int far = shadow_depth(faces, camera.eye + camera.far * ray, light);
        census.near_inside += near > 0;
        census.far_inside += far > 0;
        census.near_as_eye = census.near_as_eye && near == census.eye_depth;
        census.deepest = std::max({census.deepest, near, far});
        double depth = camera.far;
        const Face* seen = nullptr;
        for (const Face& face : faces) {
            if (glm::dot(face.normal, ray) >= 0) continue; // from behind
            const double t = hit(face, camera.eye, ray);
            if (t < camera.near || t >= depth) continue;
            depth = t;
            seen = &face;
        }
        if (seen == nullptr) continue;
        // Far above rounding, far below the size of a triangle: skips the surface itself.
        const int surface = shadow_depth(faces, camera.eye + depth * ray, light, 1e-9);
        const bool lit = seen->faces_light && surface == 0;
        census.lit += lit;
        census.shadowed += !lit;
        census.lit_before_far_inside += lit && far > 0;
        census.deepest = std::max(census.deepest, surface);
    }
    return census;
}

// Of the 4096 rays; 64 rays stand for 4096 pixels at 512 by 512.
constexpr int thousands_of_pixels = 64;

TEST(bundled, every_caster_is_closed_and_manifold) {
    for (const BundledScene& bundled : bundled_scenes()) {
        const Scene scene = load_scene(std::string(bundled.name), {});
        EXPECT_TRUE(scene.notes.empty()) << bundled.name << ": " << scene.notes.front();
        EXPECT_LT(scene.triangles.size(), 50000U);
        for (const CasterReport& report : inspect_casters(scene)) {
            EXPECT_TRUE(report.closed()) << scene.meshes[report.mesh].name;
            EXPECT_EQ(report.non_manifold_edges, 0U) << scene.meshes[report.mesh].name;
        }
    }
}

TEST(bundled, each_provokes_what_it_names_and_nothing_else) {
    for (const BundledScene& bundled : bundled_scenes()) {
        SCOPED_TRACE(bundled.name);
        const Scene scene = load_scene(std::string(bundled.name), {});
        const auto provokes = [&](Cause cause) {
            return std::find(scene.provokes.begin(), scene.provokes.end(), cause) !=
                   scene.provokes.end();
        };
        ASSERT_TRUE(scene.declares_provokes);
        const Census census = take_census(scene);
        EXPECT_GT(census.lit, thousands_of_pixels);
        EXPECT_GT(census.shadowed, thousands_of_pixels);
        EXPECT_LT(census.deepest, 8); // a counter of 4 bits would do
        EXPECT_EQ(census.eye_depth > 0, provokes(Cause::eye_inside));
        if (provokes(Cause::near_plane)) {
            EXPECT_GT(census.near_inside, thousands_of_pixels);
            EXPECT_LT(census.near_inside, grid * grid - thousands_of_pixels);
        } else {
            EXPECT_TRUE(census.near_as_eye);
        }
        if (provokes(Cause::far_plane))
            EXPECT_GT(census.lit_before_far_inside, thousands_of_pixels);
        else
            EXPECT_EQ(census.far_inside, 0);
    }
}

} // namespace
} // namespace shadowproof
