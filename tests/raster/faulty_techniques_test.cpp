// Each fault must show, in the claim or at least in the counter; or it would prove nothing.
#include "raster/render.h"
#include "tests/raster/faulty_techniques.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

namespace shadowproof::tests {
namespace {

template <class T>
std::size_t differing(const Image<T>& a, const Image<T>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (a.pixels[i] != b.pixels[i]) ++count;
    return count;
}

/// Seen along the shadow, a light aside, a near plane that twice as far lies in the volume.
Scene where_all_faults_show() {
    Scene scene = box_over_floor();
    scene.lights[0].position = {2, 6, 1};
    look_at(scene.camera, {5, 3, 0}, {-3, 0.2, 0});
    scene.camera.near = 3;
    return scene;
}

TEST(FaultyTechniques, each_changes_the_counters_of_its_right_twin) {
    const Scene scene = where_all_faults_show();
    Gpu gpu(GlPlatform::osmesa);
    const auto right = [&](const char* name) {
        return render(*find_technique(name), scene, Plan{}, gpu);
    };
    const Frame zpass = right("zpass");
    const Frame clamp = right("zfail_clamp");
    const Frame reversed = right("zfail_reversed");
    EXPECT_GT(
        differing(without_dark_cap(gpu, scene, {}).counted->counter, reversed.counted->counter),
        100U);
    EXPECT_GT(
        differing(with_swapped_steps(gpu, scene, {}).counted->counter, clamp.counted->counter),
        100U);
    EXPECT_GT(differing(without_one_side(gpu, scene, {}).counted->counter, clamp.counted->counter),
              100U);
    EXPECT_GT(
        differing(with_wrong_near_plane(gpu, scene, {}).counted->counter, zpass.counted->counter),
        100U);
    EXPECT_GT(differing(with_mirrored_light(gpu, scene, {}).claim, reversed.claim), 100U);
    Scene inside_out = scene;
    for (std::size_t i = 0; i < 12; ++i) // the box
        std::swap(inside_out.triangles[i].y, inside_out.triangles[i].z);
    look_at(inside_out.camera, {-5, 3, 0}, {3, 0.2, 0});
    const Frame culled = render(*find_technique("zpass"), inside_out, Plan{}, gpu);
    EXPECT_GT(differing(with_all_caps_hidden(gpu, inside_out, {}).counted->counter,
                        culled.counted->counter),
              100U);
}

TEST(FaultyTechniques, swapped_steps_negate_the_counter_and_keep_the_claim) {
    const Scene scene = where_all_faults_show();
    Gpu gpu(GlPlatform::osmesa);
    const Frame right = render(*find_technique("zfail_clamp"), scene, Plan{}, gpu);
    const Frame wrong = with_swapped_steps(gpu, scene, {});
    for (std::size_t i = 0; i < right.counted->counter.pixels.size(); ++i)
        ASSERT_EQ(wrong.counted->counter.pixels[i], -right.counted->counter.pixels[i] & 0xffU);
    EXPECT_EQ(differing(wrong.claim, right.claim), 0U);
}

TEST(FaultyTechniques, are_named_as_their_functions_and_known_for_what_their_twins_are) {
    ASSERT_EQ(faulty_techniques().size(), 6U);
    EXPECT_EQ(faulty_techniques()[3].name, "with_wrong_near_plane");
    EXPECT_EQ(faulty_techniques()[3].fails_at, find_technique("zpass")->fails_at);
    EXPECT_EQ(faulty_techniques()[3].run, with_wrong_near_plane);
}

} // namespace
} // namespace shadowproof::tests
