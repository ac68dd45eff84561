#include "scenes/bundled/author/stages.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"
#include "scenes/mesh/split_far_ends.h"
#include "scenes/mesh/topology.h"
#include "scenes/mesh/touching_light.h"
#include "scenes/plan/plan.h"
#include "tests/scenes/bundled_names.h"
#include "tests/scenes/small_gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>

namespace shadowproof {
namespace {

TEST(bundled, the_author_writes_the_bytes_that_are_checked_in) {
    const auto expect_written = [](const author::Stage& stage,
                                   const std::filesystem::path& folder) {
        const auto bytes = test::bytes_of(folder / (stage.name + ".gltf"));
        EXPECT_TRUE(std::string(bytes.begin(), bytes.end()) == write_gltf(stage))
            << stage.name << ": run shadowproof_author scenes/bundled";
        EXPECT_LT(bytes.size(), 300000U) << stage.name;
    };
    const std::vector<author::Stage> stages = author::all_stages();
    ASSERT_EQ(stages.size(), bundled_scenes().size());
    for (std::size_t i = 0; i < stages.size(); ++i) {
        EXPECT_EQ(stages[i].name, bundled_scenes()[i].name);
        expect_written(stages[i], bundled_folder());
    }
}

TEST(bundled, the_names_that_tests_go_by_are_those_of_the_files) {
    std::vector<std::string> under_each_light;
    std::vector<std::string> bump_lit;
    for (const std::string& name : tests::bundled_scene_names()) {
        SceneRequest request;
        request.every_light = true;
        const Scene scene = load_scene(name, request);
        for (const Light& light : scene.lights)
            under_each_light.push_back(scene.lights.size() > 1 ? name + "-" + light.choice : name);
        if (is_bump_lit(scene)) bump_lit.push_back(name);
    }
    EXPECT_EQ(tests::bundled_names(), under_each_light);
    EXPECT_EQ(tests::bump_lit_scenes(), bump_lit);
}

TEST(bundled, sun_and_spot_have_the_lights_that_they_are_named_for) {
    const auto light_of = [](const char* name) { return chosen_light(load_scene(name, {})); };
    EXPECT_EQ(light_of("sun").kind, Light::Kind::directional);
    EXPECT_EQ(light_of("spot").kind, Light::Kind::spot);
    EXPECT_NEAR(light_of("spot").outer_cone, 0.2871, 1e-6); // radians
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
    /// Surface faces the light, and what is counted between it and the far plane tells another
    /// class than is true.
    int far_miscounted = 0;
    int lit = 0; ///< surface is lit
    int shadowed = 0;
    int lit_before_far_inside = 0; ///< surface is lit and the far point in a volume
    int deepest = 0;               ///< largest shadow depth anywhere looked at
    std::map<int, int> at_depth;   ///< surfaces by their shadow depth
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
        const glm::dvec3 ray = line_of_sight(camera, (i % grid + 0.5) * camera.width / grid,
                                             (i / grid + 0.5) * camera.height / grid);
        const int near = shadow_depth(faces, camera.eye + camera.near * ray, light);
        const int far = shadow_depth(faces, camera.eye + camera.far * ray, light);
        census.near_inside += near > 0;
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
        census.far_miscounted += seen->faces_light && (surface == far) != lit;
        census.deepest = std::max(census.deepest, surface);
        ++census.at_depth[surface];
    }
    return census;
}

// Of the 4096 rays; 64 rays stand for 4096 pixels at 512 by 512.
constexpr int thousands_of_pixels = 64;

bool provokes(const Scene& scene, Cause cause) {
    return std::find(scene.provokes.begin(), scene.provokes.end(), cause) != scene.provokes.end();
}

Scene bundled(std::string_view name) {
    return load_scene(std::string(name), {});
}

/// The report of the mesh of that name.
CasterReport report_of(const Scene& scene, std::string_view mesh) {
    for (const CasterReport& report : inspect_casters(scene))
        if (scene.meshes[report.mesh].name == mesh) return report;
    ADD_FAILURE() << "no mesh " << mesh;
    return {};
}

/// Vertices of a mesh, a triangle's three at a time.
std::vector<glm::dvec3> corners_of(const Scene& scene, std::string_view name) {
    std::vector<glm::dvec3> corners;
    for (const Mesh& mesh : scene.meshes)
        for (std::uint32_t i = 0; mesh.name == name && i < 3 * mesh.triangle_count; ++i)
            corners.push_back(corner(scene, mesh.first_triangle + i / 3, static_cast<int>(i % 3)));
    EXPECT_FALSE(corners.empty()) << "no mesh " << name;
    return corners;
}

TEST(bundled, every_caster_is_closed_and_manifold_but_those_that_are_to_be_faulty) {
    const std::map<std::string_view, std::string_view> faulty{{"open_lid", "open box"},
                                                              {"inverted", "box inside out"},
                                                              {"non_manifold", "twin boxes"},
                                                              {"t_junctions", "patched box"}};
    for (const BundledScene& each : bundled_scenes()) {
        const Scene scene = bundled(each.name);
        EXPECT_LT(scene.triangles.size(), 50000U);
        for (const CasterReport& report : inspect_casters(scene)) {
            const std::string& mesh = scene.meshes[report.mesh].name;
            const auto expected = faulty.find(each.name);
            const bool is_faulty = expected != faulty.end() && expected->second == mesh;
            EXPECT_EQ(words_of(scene, report).empty(), !is_faulty) << each.name << ", " << mesh;
        }
    }
}

TEST(bundled, only_a_choice_of_time_or_light_and_a_range_are_noted) {
    for (const BundledScene& each : bundled_scenes()) {
        const bool chooses = each.name == "moving_light" || each.name == "many_lights" ||
                             each.name == "bumpy_lights" || each.name == "walking_figure" ||
                             each.name == "light_range";
        EXPECT_EQ(bundled(each.name).notes.size(), chooses ? 1U : 0U) << each.name;
    }
}

TEST(bundled, each_provokes_what_it_names_and_nothing_else) {
    for (const BundledScene& each : bundled_scenes()) {
        SCOPED_TRACE(each.name);
        const Scene scene = bundled(each.name);
        ASSERT_TRUE(scene.declares_provokes);
        const Census census = take_census(scene);
        EXPECT_GT(census.lit, thousands_of_pixels);
        EXPECT_GT(census.shadowed, thousands_of_pixels);
        if (provokes(scene, Cause::counter))
            EXPECT_GT(census.at_depth.at(256), thousands_of_pixels); // 0 in 8 bits
        else
            EXPECT_LT(census.deepest, 8);            // a counter of 4 bits would do
        const bool tie = each.name == "eye_on_side"; // plain double may see either
        EXPECT_TRUE(tie || (census.eye_depth > 0) == provokes(scene, Cause::eye_inside));
        if (provokes(scene, Cause::near_plane)) {
            EXPECT_GT(census.near_inside, thousands_of_pixels);
            EXPECT_LT(census.near_inside, grid * grid - thousands_of_pixels);
        } else {
            EXPECT_TRUE(census.near_as_eye);
        }
        // What a closed caster around the light darkens, no triangle that faces it tells.
        if (provokes(scene, Cause::far_plane) && !provokes(scene, Cause::light_inside))
            EXPECT_GT(census.lit_before_far_inside, thousands_of_pixels);
        else
            EXPECT_EQ(census.far_miscounted, 0);
    }
}

TEST(bundled, the_light_projects_all_some_or_none_of_an_occluder_onto_the_near_plane) {
    // Kilgard 2001: a vertex reaches the near plane where it lies between that and the light.
    const auto reaching = [](const char* name, const char* mesh) {
        const Scene scene = bundled(name);
        const double light = view_depth(scene.camera, chosen_light(scene).position);
        const std::vector<glm::dvec3> corners = corners_of(scene, mesh);
        const auto count = std::count_if(corners.begin(), corners.end(), [&](const auto& point) {
            const double depth = view_depth(scene.camera, point);
            return depth > scene.camera.near && depth < light;
        });
        return static_cast<double>(count) / static_cast<double>(corners.size());
    };
    EXPECT_EQ(reaching("near_cap_all", "ring"), 1);
    EXPECT_GT(reaching("near_cap_some", "rod"), 0.2);
    EXPECT_LT(reaching("near_cap_some", "rod"), 0.8);
    EXPECT_EQ(reaching("near_cap_none", "halo"), 0);
}

TEST(bundled, the_eye_lies_exactly_on_a_side_of_the_shard_and_of_nothing_else) {
    const Scene scene = bundled("eye_on_side");
    const glm::dvec3 light = chosen_light(scene).position;
    const auto sides_through_eye = [&](std::string_view mesh) {
        const std::vector<glm::dvec3> corners = corners_of(scene, mesh);
        int count = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) { // each edge once a direction
            const glm::dvec3 a = corners[i] - light;
            const glm::dvec3 b = corners[i % 3 == 2 ? i - 2 : i + 1] - light;
            count += glm::dot(scene.camera.eye - light, glm::cross(a, b)) == 0;
        }
        return count;
    };
    EXPECT_EQ(sides_through_eye("shard"), 2);
    EXPECT_EQ(sides_through_eye("apple"), 0);
}

TEST(bundled, the_light_lies_exactly_in_planes_of_three_bodies_and_not_of_the_ball) {
    const Scene scene = bundled("light_in_plane");
    const auto faces_edge_on = [&](std::string_view mesh) {
        const std::vector<glm::dvec3> corners = corners_of(scene, mesh);
        int count = 0;
        for (std::size_t i = 0; i < corners.size(); i += 3)
            count += glm::dot(glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]),
                              chosen_light(scene).position - corners[i]) == 0;
        return count;
    };
    EXPECT_EQ(faces_edge_on("ramp"), 2);
    EXPECT_EQ(faces_edge_on("left box"), 32);
    EXPECT_EQ(faces_edge_on("back box"), 32);
    EXPECT_EQ(faces_edge_on("ball"), 0);
}

TEST(bundled, the_light_touches_one_triangle_of_the_board_from_outside) {
    const Scene scene = bundled("light_on_face");
    const std::vector<std::uint32_t> touching = triangles_touching_light(scene);
    ASSERT_EQ(touching.size(), 1U);
    EXPECT_EQ(scene.meshes[mesh_of(scene, touching.front())].name, "board");
    EXPECT_GT(side(scene, touching.front(), homogeneous(chosen_light(scene))), 0);
    EXPECT_TRUE(make_plan(scene).around_light.empty());
}

TEST(bundled, the_light_touches_an_edge_of_the_board_from_outside_of_one_of_its_faces) {
    const Scene scene = bundled("light_on_edge");
    int facing = 0;
    for (const std::uint32_t triangle : triangles_touching_light(scene)) {
        EXPECT_EQ(scene.meshes[mesh_of(scene, triangle)].name, "board");
        facing += side(scene, triangle, homogeneous(chosen_light(scene))) > 0 ? 1 : 0;
    }
    EXPECT_EQ(facing, 1);
    EXPECT_EQ(split_far_ends(scene).across_edge.size(), 1U);
}

TEST(bundled, eye_and_light_are_inside_the_glass) {
    const Scene scene = bundled("light_inside");
    for (const glm::dvec3& point : {scene.camera.eye, chosen_light(scene).position}) {
        const std::vector<glm::dvec3> glass = corners_of(scene, "glass");
        for (std::size_t i = 0; i < glass.size(); i += 3) // convex: behind every face
            EXPECT_LT(glm::dot(glm::cross(glass[i + 1] - glass[i], glass[i + 2] - glass[i]),
                               point - glass[i]),
                      0);
    }
}

TEST(bundled, shadows_overlap_by_twos_and_threes) {
    const Census census = take_census(bundled("overlapping"));
    EXPECT_GT(census.at_depth.at(2), 30); // a hundredth of the picture's rays
    EXPECT_GT(census.at_depth.at(3), 10);
    EXPECT_FALSE(census.at_depth.contains(4));
}

TEST(bundled, a_long_shadow_ends_further_from_its_post_than_the_scene_is_wide_from_its_middle) {
    const Scene scene = bundled("long_shadow");
    const glm::dvec3 light = chosen_light(scene).position;
    double radius = 0; // of the runway, which all stands on, around the origin
    for (const glm::dvec3& point : corners_of(scene, "runway"))
        radius = std::max(radius, glm::length(point));
    double longest = 0;
    for (const glm::dvec3& point : corners_of(scene, "post"))
        longest = std::max(longest, glm::distance(point, light) * point.y / (light.y - point.y));
    EXPECT_GT(longest, 1.1 * radius);
}

TEST(bundled, the_faults_of_casters_are_those_that_their_scenes_are_named_for) {
    const CasterReport open = report_of(bundled("open_lid"), "open box");
    EXPECT_EQ(open.rings, 1U);
    EXPECT_EQ(open.boundary_edges, 16U); // four a side
    EXPECT_TRUE(report_of(bundled("inverted"), "box inside out").inverted);
    const CasterReport twins = report_of(bundled("non_manifold"), "twin boxes");
    EXPECT_EQ(twins.non_manifold_edges, 3U);
    EXPECT_TRUE(twins.closed());
    EXPECT_FALSE(report_of(bundled("t_junctions"), "patched box").closed());
}

TEST(bundled, a_box_with_t_junctions_is_closed_but_for_its_topology) {
    // The areas of a closed surface, as vectors, add up to zero; those of a box less a face do not.
    const std::vector<glm::dvec3> corners = corners_of(bundled("t_junctions"), "patched box");
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < corners.size(); i += 3)
        sum += glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
    EXPECT_EQ(sum, glm::dvec3(0));
}

TEST(bundled, the_light_moves_straight_within_four_seconds_and_rests_before_and_after) {
    const auto light_at = [](double time) {
        SceneRequest request;
        request.time = time;
        return chosen_light(load_scene("moving_light", request)).position;
    };
    EXPECT_EQ(light_at(-1), light_at(0));
    EXPECT_EQ(light_at(9), light_at(4));
    EXPECT_GT(glm::distance(light_at(0), light_at(4)), 5);
    EXPECT_LT(glm::distance(light_at(2), (light_at(0) + light_at(4)) / 2.0), 1e-6);
}

TEST(bundled, each_of_many_lights_is_chosen_by_its_name) {
    for (const char* name : {"key", "fill", "rim"}) {
        SceneRequest request;
        request.light = name;
        const Scene scene = load_scene("many_lights", request);
        EXPECT_EQ(chosen_light(scene).name, name);
        EXPECT_EQ(scene.lights.size(), 3U);
    }
}

/// The walking figure's lowest height under its left or its right half, as the root joint has
/// them: its left is across from where it heads.
double lowest_of_figure(double time, bool left) {
    SceneRequest request;
    request.time = time;
    const Scene scene = load_scene("walking_figure", request);
    const std::vector<glm::dvec3> legs = corners_of(scene, "legs");
    glm::dvec3 middle(0);
    for (const glm::dvec3& point : legs) middle += point / static_cast<double>(legs.size());
    constexpr double heading = 0.9371; // radians from +z towards +x
    const glm::dvec3 to_left(std::cos(heading), 0, -std::sin(heading));
    double lowest = 99;
    for (const glm::dvec3& point : legs)
        if ((glm::dot(point - middle, to_left) > 0) == left) lowest = std::min(lowest, point.y);
    return lowest;
}

TEST(bundled, the_figure_never_sinks_into_the_floor_and_lifts_its_feet_in_turn) {
    bool lifted[2]{};
    for (int i = 0; i < 32; ++i) {
        const double left = lowest_of_figure(i / 16.0, true);
        const double right = lowest_of_figure(i / 16.0, false);
        EXPECT_GT(std::min(left, right), 0) << i;
        EXPECT_LT(std::min(left, right), 0.05) << i; // one foot is down, but for its clearance
        lifted[0] = lifted[0] || left > 0.1;
        lifted[1] = lifted[1] || right > 0.1;
    }
    EXPECT_TRUE(lifted[0] && lifted[1]);
}

TEST(bundled, the_figure_is_posed_by_morph_targets_and_by_joints_within_two_seconds) {
    const auto part_at = [](double time, const char* part) {
        SceneRequest request;
        request.time = time;
        std::vector<glm::dvec3> corners = corners_of(load_scene("walking_figure", request), part);
        const glm::dvec3 first = corners.front(); // so that the way it goes does not count
        for (glm::dvec3& corner : corners) corner -= first;
        return corners;
    };
    const auto furthest = [](const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
        double most = 0;
        for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::distance(a[i], b[i]));
        return most;
    };
    for (const char* part : {"trunk", "arms", "legs"}) {
        SCOPED_TRACE(part);
        EXPECT_GT(furthest(part_at(0.5, part), part_at(1.5, part)), 0.1);
        // A stride later, and ever after, it stands as at first; but for rounding to float.
        EXPECT_LT(furthest(part_at(0, part), part_at(2, part)), 1e-5);
        EXPECT_EQ(part_at(2, part), part_at(7, part));
    }
}

} // namespace
} // namespace shadowproof
