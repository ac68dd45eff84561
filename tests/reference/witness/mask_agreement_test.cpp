// Truth and witness, which share no code, on scenes with alpha masks.
#include "reference/witness/agreement.h"
#include "scenes/load/catalog.h"
#include "scenes/surface/alpha_mask.h"
#include "tests/raster/masked_scene.h"

#include <gtest/gtest.h>

namespace shadowproof {
namespace {

TEST(MaskAgreement, witness_and_truth_agree_at_every_pixel_of_diced_masks) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Scene scene = tests::masked_scene(seed);
        scene.camera.width = scene.camera.height = 40;
        const Agreement agreement = ask_witness(scene, trace(Tracer(scene)), 1'000'000, 0);
        EXPECT_EQ(agreement.disagreements, 0U) << seed << ": " << words_of(agreement);
    }
}

TEST(MaskAgreement, filters_change_nothing) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Scene scene = tests::masked_scene(seed);
        const Tracer tracer(scene);
        const GroundTruth quick = trace(tracer);
        const GroundTruth exact = trace(tracer, Filters::off);
        EXPECT_EQ(quick.visibility.pixels, exact.visibility.pixels) << seed;
        EXPECT_EQ(quick.triangle.pixels, exact.triangle.pixels) << seed;
    }
}

TEST(MaskAgreement, the_bundled_sheets_have_holes_to_see_and_to_light_through) {
    SceneRequest request;
    request.width = request.height = 64;
    const Scene scene = load_scene("perforated", request);
    const Scene whole = without_masks(scene);
    const GroundTruth truth = trace(Tracer(scene));
    const GroundTruth without = trace(Tracer(whole));
    std::size_t seen_through = 0;
    std::size_t lit_through = 0;
    for (std::size_t i = 0; i < truth.visibility.pixels.size(); ++i) {
        const bool same = truth.triangle.pixels[i] == without.triangle.pixels[i];
        seen_through += same ? 0 : 1;
        lit_through += same && truth.visibility.pixels[i] == Visibility::lit &&
                               without.visibility.pixels[i] == Visibility::shadowed
                           ? 1
                           : 0;
    }
    EXPECT_GT(seen_through, 60U);
    EXPECT_GT(lit_through, 10U);
    EXPECT_EQ(ask_witness(scene, truth, 1'000'000, 0).disagreements, 0U);
}

} // namespace
} // namespace shadowproof
