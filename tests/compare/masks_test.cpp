// Alpha masks: what techniques of all families make of them is predicted at every pixel, volumes
// fail as whole triangles must, and faults in reading a mask are caught.
#include "compare/verdict.h"
#include "raster/gl/context.h"
#include "scenes/surface/alpha_mask.h"
#include "tests/compare/traced_bundled.h"
#include "tests/raster/masked_scene.h"

#include <gtest/gtest.h>

#include <array>

namespace shadowproof {
namespace {

using tests::compared;
using tests::pixels_of;
using tests::traced_bundled;
using tests::TracedScene;

/// One of each way of counting, of drawing maps, of tracing.
constexpr std::array names{"zfail_reversed",
                           "zpass",
                           "zfail",
                           "zfail_saturate",
                           "zfail_truncated",
                           "zfail_no_light_cap",
                           "invert",
                           "zpass_capped",
                           "zfail_geometry_shader",
                           "auto",
                           "cube_map_six_pass",
                           "cube_map_geometry_shader",
                           "cube_map_pcf",
                           "sun_map",
                           "spot_map",
                           "spot_map_stencil",
                           "spot_map_dual_texture",
                           "traced_epsilon",
                           "traced_skip"};

class Masks : public testing::Test {
protected:
    static Gpu& gpu() {
        static Gpu one(GlPlatform::osmesa);
        return one;
    }
    static Frame drawn(const TracedScene& traced, std::string_view name) {
        return render(*find_technique(name), traced.scene, traced.plan, gpu());
    }
    static Frame drawn_whole(const TracedScene& traced, std::string_view name) {
        const Scene whole = without_masks(traced.scene);
        return render(*find_technique(name), whole, traced.plan, gpu());
    }
    static std::uint64_t unexplained(const Comparison& comparison) {
        return comparison.evidence.unexplained + pixels_of(comparison, Cause::unexplained);
    }
};

TEST_F(Masks, of_all_kinds_are_predicted_in_all_families) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const TracedScene traced(tests::masked_scene(seed));
        for (const char* name : names) {
            if (!suits(*find_technique(name), traced.scene)) continue;
            const Comparison comparison = compared(traced, drawn(traced, name));
            EXPECT_EQ(unexplained(comparison), 0U)
                << seed << " " << name << ": " << comparison.summary.words;
        }
    }
}

TEST_F(Masks, that_volumes_know_nothing_of_are_named_where_whole_casters_would_be_right) {
    const TracedScene& traced = traced_bundled("perforated");
    const Comparison volumes = compared(traced, drawn(traced, "zfail_reversed"));
    std::uint64_t expected = 0;
    for (int y = 0; y < traced.scene.camera.height; ++y)
        for (int x = 0; x < traced.scene.camera.width; ++x) {
            if (traced.truth.visibility.at(x, y) != Visibility::lit) continue;
            const bool falls_on_holes =
                count_let_through(traced.tracer,
                                  line_of_sight(traced.scene.camera, x + 0.5, y + 0.5),
                                  traced.truth.triangle.at(x, y)) > 0;
            expected += falls_on_holes ? 1 : 0;
            const auto cause = static_cast<Cause>(volumes.cause.at(x, y));
            EXPECT_TRUE(!falls_on_holes || cause == Cause::alpha || cause == Cause::edge)
                << x << " " << y;
        }
    EXPECT_GT(expected, 1000U);
    EXPECT_NEAR(static_cast<double>(pixels_of(volumes, Cause::alpha)),
                static_cast<double>(expected), 0.01 * static_cast<double>(expected));
    EXPECT_EQ(unexplained(volumes), 0U);
    for (const char* name : {"cube_map_six_pass", "traced_skip"})
        EXPECT_EQ(pixels_of(compared(traced, drawn(traced, name)), Cause::alpha), 0U) << name;
}

TEST_F(Masks, that_the_surface_pass_ignores_are_caught) {
    const TracedScene& traced = traced_bundled("perforated");
    for (const char* name : {"zfail_reversed", "cube_map_six_pass", "traced_skip"})
        EXPECT_GT(unexplained(compared(traced, drawn_whole(traced, name))), 500U) << name;
}

TEST_F(Masks, that_leave_too_much_out_are_caught) {
    const TracedScene& traced = traced_bundled("perforated");
    Scene less = traced.scene;
    for (AlphaMask& mask : less.masks) mask.least = 2;
    for (const char* name : {"zfail_reversed", "cube_map_six_pass", "traced_skip"}) {
        const Frame frame = render(*find_technique(name), less, traced.plan, gpu());
        EXPECT_GT(unexplained(compared(traced, frame)), 5000U) << name;
    }
}

TEST_F(Masks, that_a_map_ignores_are_caught) {
    const TracedScene& traced = traced_bundled("perforated");
    Frame frame = drawn(traced, "cube_map_six_pass");
    const Frame whole = drawn_whole(traced, "cube_map_six_pass");
    frame.mapped->faces = whole.mapped->faces;
    EXPECT_GT(unexplained(compared(traced, frame)), 500U);
}

TEST_F(Masks, that_shadow_rays_ignore_are_caught) {
    const TracedScene& traced = traced_bundled("perforated");
    Frame frame = drawn(traced, "traced_skip");
    const Frame whole = drawn_whole(traced, "traced_skip");
    for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i) {
        if (frame.rays->pixels.pixels[i].seen != whole.rays->pixels.pixels[i].seen) continue;
        frame.rays->pixels.pixels[i] = whole.rays->pixels.pixels[i];
        frame.claim.pixels[i] = whole.claim.pixels[i];
    }
    EXPECT_GT(unexplained(compared(traced, frame)), 500U);
}

TEST_F(Masks, whose_cutoff_is_off_by_a_byte_are_caught) {
    const TracedScene& traced = traced_bundled("perforated");
    Scene off = traced.scene;
    for (AlphaMask& mask : off.masks) mask.least += 1.0 / 255;
    for (const char* name : {"zfail_reversed", "cube_map_six_pass", "traced_skip"}) {
        const Frame frame = render(*find_technique(name), off, traced.plan, gpu());
        EXPECT_GT(unexplained(compared(traced, frame)), 20U) << name;
    }
}

TEST_F(Masks, that_a_counter_seems_to_know_of_are_caught) {
    const TracedScene& traced = traced_bundled("perforated");
    Frame frame = drawn(traced, "zfail_reversed");
    const Comparison right = compared(traced, frame);
    for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i)
        if (right.cause.pixels[i] == static_cast<std::uint8_t>(Cause::alpha)) {
            frame.counted->counter.pixels[i] = 0;
            frame.claim.pixels[i] = Visibility::lit;
        }
    EXPECT_GT(unexplained(compared(traced, frame)), 1000U);
}

} // namespace
} // namespace shadowproof
