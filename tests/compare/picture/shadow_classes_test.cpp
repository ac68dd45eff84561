// What is read from a right picture is right, at every angle at which the light falls.
#include "compare/picture/shadow_classes.h"
#include "compare/picture/surface_colors.h"
#include "scenes/camera.h"
#include "tests/compare/traced_bundled.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof {
namespace {

double srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// A renderer's: white and diffuse, sRGB in 8 bits, with ambient light.
Picture diffuse(const TracedScene& traced, double intensity) {
    constexpr double ambient = 0.1;
    const Scene& scene = traced.scene();
    const GroundTruth& truth = traced.truth();
    Picture picture{truth.depth.width, truth.depth.height, 1, 8, {}};
    for (int y = 0; y < truth.depth.height; ++y)
        for (int x = 0; x < truth.depth.width; ++x) {
            double light = 0;
            if (truth.visibility.at(x, y) != Visibility::background) light = ambient;
            if (truth.visibility.at(x, y) == Visibility::lit) {
                const glm::dvec3 point =
                    scene.camera.eye +
                    truth.depth.at(x, y) * ray_direction(scene.camera, x + 0.5, y + 0.5);
                light += intensity * sine_to_light(scene, truth.triangle.at(x, y), point);
            }
            picture.values.push_back(
                static_cast<float>(std::round(255 * srgb(std::min(light, 1.0))) / 255));
        }
    return picture;
}

class PictureOf : public testing::TestWithParam<const char*> {};

TEST_P(PictureOf, a_right_renderer_shows_no_wrong_pixel_however_the_light_grazes) {
    const TracedScene& traced = tests::traced_bundled(GetParam()).traced;
    for (const bool with_twin : {true, false}) {
        std::optional<Picture> twin;
        if (with_twin) twin = diffuse(traced, 0);
        const Frame frame = read_shadows(traced, {"mine.png", "", ""}, diffuse(traced, 0.5), twin);
        std::size_t decided = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i) {
            decided += frame.pictured->decided.pixels[i];
            wrong += frame.claim.pixels[i] != traced.truth().visibility.pixels[i] ? 1U : 0U;
        }
        EXPECT_EQ(wrong, 0U);
        // As good as all: undecided is only what light adds two of 255 steps to, or less.
        EXPECT_LE(frame.pictured->undecidable * 100, decided);
    }
}

INSTANTIATE_TEST_SUITE_P(Bundled, PictureOf,
                         testing::Values("ordinary", "sun", "spot", "nested", "overlapping"),
                         [](const auto& tested) { return tested.param; });

} // namespace
} // namespace shadowproof
