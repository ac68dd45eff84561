#include "scenes/load/catalog.h"
#include "tests/compare/traced_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowproof {
namespace {

/// What volumes of each length show is predicted, from none at all to further than anything.
TEST(Extrusion, of_any_length_is_explained) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"long_shadow", "open_lid", "light_inside"}) {
        tests::TracedScene traced(
            load_scene(name, {.camera = {}, .light = {}, .time = 0, .width = 60, .height = 45}));
        std::uint64_t before = ~std::uint64_t{0};
        for (const double length : {0.0, 1e-6, 0.1, 1.0, 10.0, 1e3, 1e6, 1e12, 0x1p61}) {
            SCOPED_TRACE(fmt::format("{} {}", name, length));
            traced.plan.asked.volumes.extrusion = length * traced.scene.unit;
            const Comparison comparison = tests::compared(traced, "zfail_truncated", gpu);
            EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U);
            EXPECT_EQ(comparison.evidence.unexplained, 0U);
            const std::uint64_t too_short = pixels_of(comparison, Cause::extrusion);
            if (length < 0.1) continue; // there floats cannot tell a volume's ends apart
            EXPECT_LE(too_short, before);
            if (length == 0.1) {
                EXPECT_GT(too_short, 0U);
            }
            before = too_short;
        }
        EXPECT_EQ(before, 0U);
    }
}

} // namespace
} // namespace shadowproof
