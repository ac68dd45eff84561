// A light in the near plane, or next to it: what is projected onto that plane lies far away, or
// anywhere, and the counter is predicted all the same.
#include "scenes/load/catalog.h"
#include "tests/compare/traced_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowproof::tests {
namespace {

constexpr const char* note_of_what_is_left_out =
    "the near plane's occluders: the light is so near that plane, or a caster, that floats cannot "
    "project onto it";

/// `ordinary` seen by a level camera so close that its near plane cuts casters.
Scene level(int size, const Light& light) {
    SceneRequest request;
    request.width = request.height = size;
    Scene scene = load_scene("ordinary", request);
    Camera& camera = scene.camera;
    camera.forward = {0, 0, -1};
    camera.right = {1, 0, 0};
    camera.up = {0, 1, 0};
    camera.eye = {-0.5, 2, 1.5};
    scene.lights = {light};
    scene.declares_provokes = false;
    return scene;
}

/// A sun that shines straight down, but for `depth` along the view.
Scene at_noon(int size, double depth) {
    Light sun;
    sun.kind = Light::Kind::directional;
    sun.direction = {0, -1, -depth};
    return level(size, sun);
}

/// A lamp above, `depth` beyond the near plane.
Scene under_a_lamp(int size, double depth) {
    Scene scene = level(size, Light{});
    scene.lights.front().position = scene.camera.eye + glm::dvec3(0.3, 6, 0) +
                                    (scene.camera.near + depth) * scene.camera.forward;
    return scene;
}

void expect_explained(const TracedScene& traced, const Frame& frame, const std::string& what) {
    const Comparison comparison = compared(traced, frame);
    EXPECT_EQ(comparison.evidence.unexplained, 0U) << what;
    EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U) << what;
    EXPECT_EQ(comparison.too_near, 0U) << what;
}

TEST(NearLight, counters_under_it_are_explained_whatever_its_distance_from_the_near_plane) {
    Gpu gpu(GlPlatform::osmesa);
    int near_plane_pixels = 0;
    for (const double depth :
         {0.0, 2.2e-16, -2.2e-16, 1e-12, 1e-8, -1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1})
        for (const int size : {40, 100})
            for (const bool noon : {true, false}) {
                const TracedScene traced(noon ? at_noon(size, depth) : under_a_lamp(size, depth));
                for (const char* technique : {"zp_plus", "zpass_capped"}) {
                    const Frame frame =
                        render(*find_technique(technique), traced.scene, traced.plan, gpu);
                    expect_explained(traced, frame,
                                     fmt::format("{} {} {} {}", technique, depth, size, noon));
                    near_plane_pixels +=
                        static_cast<int>(pixels_of(compared(traced, frame), Cause::near_plane));
                }
            }
    EXPECT_GT(near_plane_pixels, 0);
}

TEST(NearLight, counts_from_the_eye_where_floats_cannot_project_and_says_so) {
    Gpu gpu(GlPlatform::osmesa);
    const auto left_out = [&](double depth) {
        const Scene scene = at_noon(64, depth);
        return render(*find_technique("zp_plus"), scene, make_plan(scene), gpu).left_out;
    };
    const std::vector<std::string> said{note_of_what_is_left_out};
    EXPECT_EQ(left_out(0), said);
    EXPECT_EQ(left_out(2.2e-16), said);
    EXPECT_EQ(left_out(1e-6), said);
    EXPECT_TRUE(left_out(0.1).empty());
}

TEST(NearLight, a_wrong_counter_under_it_is_unexplained_at_any_size_of_the_picture) {
    Gpu gpu(GlPlatform::osmesa);
    for (const int size : {40, 100})
        for (const double depth : {0.0, 2.2e-16, 1e-5})
            for (const char* technique : {"zp_plus", "zpass_capped"}) {
                const TracedScene traced(at_noon(size, depth));
                const Frame frame =
                    render(*find_technique(technique), traced.scene, traced.plan, gpu);
                Frame wrong = frame;
                std::uint64_t changed = 0;
                for (int y = 2; y < size - 2; y += 6)
                    for (int x = 2; x < size - 2; x += 6, ++changed)
                        ++wrong.counted->counter.at(x, y);
                EXPECT_EQ(compared(traced, frame).evidence.unexplained, 0U);
                EXPECT_GE(compared(traced, wrong).evidence.unexplained, changed - changed / 10)
                    << technique << ' ' << size << ' ' << depth;
            }
}

} // namespace
} // namespace shadowproof::tests
