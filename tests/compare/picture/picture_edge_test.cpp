// A renderer's vertices may lie on a grid of a sixteenth of a pixel: so its picture may have
// outlines half of that from the truth's, and what is wrong further away is not excused.
#include "compare/picture/predict.h"
#include "compare/picture/reading/shadow_classes.h"
#include "scenes/camera.h"
#include "tests/compare/traced_bundled.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace shadowproof {
namespace {

/// Whether anywhere within `reach` pixels of its centre to each side, the pixel's mesh is seen in
/// another light, or something else is seen.
bool changes_within(const TracedScene& traced, int x, int y, double reach) {
    constexpr int steps = 8;
    const Scene& scene = traced.scene();
    std::vector<glm::dvec3> rays;
    for (int down = -steps; down <= steps; ++down)
        for (int right = -steps; right <= steps; ++right)
            rays.push_back(line_of_sight(scene.camera, x + 0.5 + reach * right / steps,
                                         y + 0.5 + reach * down / steps));
    const std::uint32_t own = mesh_of(scene, traced.truth().triangle.at(x, y));
    for (const RayTruth& seen : trace_rays(traced.tracer(), rays))
        if (seen.triangle == no_triangle || mesh_of(scene, seen.triangle) != own ||
            seen.visibility != traced.truth().visibility.at(x, y))
            return true;
    return false;
}

class PictureEdge : public testing::TestWithParam<std::string> {
protected:
    const tests::TracedScene& scene = tests::traced_bundled(GetParam());
    const TracedScene& traced = scene.traced;

    /// The pixels beside outlines for which `wanted` holds.
    template <class Wanted>
    std::vector<std::size_t> beside_outlines(const Wanted& wanted) const {
        const Image<Visibility>& truth = traced.truth().visibility;
        std::vector<std::size_t> pixels;
        for (int y = 0; y < truth.height; ++y)
            for (int x = 0; x + 1 < truth.width; ++x) {
                const bool is_beside = truth.at(x, y) != truth.at(x + 1, y);
                if (is_beside && may_be_lit(traced, truth.index(x, y)) && wanted(x, y))
                    pixels.push_back(truth.index(x, y));
            }
        return pixels;
    }

    /// What a picture is found to be that is wrong at these pixels alone.
    Comparison judged_with_wrong(const std::vector<std::size_t>& pixels) const {
        const Image<Visibility>& truth = traced.truth().visibility;
        Picture mask{truth.width, truth.height, 1, 8, {}};
        for (const Visibility& pixel : truth.pixels)
            mask.values.push_back(pixel == Visibility::lit ? 1.0F : 0.0F);
        for (const std::size_t i : pixels) mask.values[i] = 1 - mask.values[i];
        return tests::compared(scene,
                               read_shadows(traced, {"mine.png", "mask.png", "", ""}, mask, {}));
    }
};

TEST_P(PictureEdge, reaches_half_a_sixteenth_of_a_pixel) {
    constexpr double inside = 1.0 / 64;
    const auto near =
        beside_outlines([&](int x, int y) { return changes_within(traced, x, y, inside); });
    ASSERT_FALSE(near.empty());
    const Comparison comparison = judged_with_wrong(near);
    for (const std::size_t i : near)
        EXPECT_EQ(comparison.cause.pixels[i], static_cast<std::uint8_t>(Cause::edge)) << i;
}

// Beside outlines that the clipper makes it reaches a sixteenth further: their ends are snapped
// too.
TEST_P(PictureEdge, reaches_no_eighth_of_a_pixel) {
    constexpr double outside = 1.0 / 8;
    const auto far =
        beside_outlines([&](int x, int y) { return !changes_within(traced, x, y, outside); });
    ASSERT_FALSE(far.empty());
    const Comparison comparison = judged_with_wrong(far);
    for (const std::size_t i : far)
        EXPECT_EQ(comparison.cause.pixels[i], static_cast<std::uint8_t>(Cause::unexplained)) << i;
}

INSTANTIATE_TEST_SUITE_P(Bundled, PictureEdge,
                         testing::Values("ordinary", "sun", "spot", "overlapping"));

} // namespace
} // namespace shadowproof
