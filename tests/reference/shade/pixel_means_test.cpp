#include "reference/shade/pixel_means.h"
#include "reference/shade/shading.h"
#include "scenes/load/catalog.h"
#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

namespace shadowproof {
namespace {

Scene picture_of(const std::string& name, int width, int height) {
    SceneRequest request;
    request.width = width;
    request.height = height;
    return load_scene(name, request);
}

constexpr double rounding = 1e-12;

/// The rays of some pixels, traced one by one.
TEST(PixelMeans, are_those_of_rays_through_the_middles_of_equal_rectangles) {
    const Scene scene = picture_of("distant_bumps", 160, 160);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const PixelMeans means = shade_pixels(tracer, truth);
    RayShader shader(tracer);
    int oblong = 0;
    int mixed = 0;
    for (int y = 3; y < 160; y += 11)
        for (int x = 5; x < 160; x += 13) {
            const glm::ivec2 rays(means.rays.at(x, y));
            oblong += rays.x != rays.y ? 1 : 0;
            const RayTruth centre =
                trace_ray(tracer, line_of_sight(scene.camera, x + 0.5, y + 0.5));
            const auto is_like_centre = [&](const RayTruth& seen) {
                return centre.triangle != no_triangle &&
                       mesh_of(scene, seen.triangle) == mesh_of(scene, centre.triangle) &&
                       seen.visibility == centre.visibility;
            };
            glm::dvec3 sum(0);
            glm::dvec3 alike(0);
            int like_centre = 0;
            for (int j = 0; j < rays.y; ++j)
                for (int i = 0; i < rays.x; ++i) {
                    const SeenPoint point{line_of_sight(scene.camera, x + (i + 0.5) / rays.x,
                                                        y + (j + 0.5) / rays.y)};
                    const RayTruth seen = trace_ray(tracer, point.line);
                    if (seen.triangle == no_triangle) continue;
                    const std::array points{
                        SeenPoint{point.line, seen.triangle, seen.visibility == Visibility::lit}};
                    std::array<Shading, 1> shading{};
                    shader.shade(points, shading);
                    sum += shading[0].color();
                    if (!is_like_centre(seen)) continue;
                    alike += shading[0].color();
                    ++like_centre;
                }
            const double all = rays.x * rays.y;
            EXPECT_LT(glm::distance(means.color.at(x, y), sum / all), rounding);
            EXPECT_EQ(means.share_alike.at(x, y), static_cast<float>(like_centre / all));
            const glm::dvec3 mean = like_centre > 0 ? alike / (1.0 * like_centre) : alike;
            EXPECT_LT(glm::distance(means.alike.at(x, y), mean), rounding);
            mixed += like_centre > 0 && like_centre < all ? 1 : 0;
        }
    EXPECT_GT(oblong, 10);
    EXPECT_GT(mixed, 5);
}

TEST(PixelMeans, take_more_rays_the_more_texels_a_pixel_covers) {
    const Scene scene = picture_of("distant_bumps", 96, 96);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const PixelMeans means = shade_pixels(tracer, truth);
    int fewest = 0;
    int most = 0;
    for (std::size_t i = 0; i < means.rays.pixels.size(); ++i) {
        const auto longer =
            static_cast<float>(std::max(means.rays.pixels[i].x, means.rays.pixels[i].y));
        const float texels = means.texels.pixels[i];
        if (truth.triangle.pixels[i] == no_triangle) {
            EXPECT_EQ(longer, 4);
            EXPECT_EQ(texels, 0);
            continue;
        }
        // Four along a texel, or 32; and no more than twice as many.
        EXPECT_GE(longer, std::min(32.F, std::max(4.F, 3.999F * texels)));
        EXPECT_LT(longer, std::max(4.001F, 8.001F * texels));
        fewest += longer == 4 ? 1 : 0;
        most += longer == 32 ? 1 : 0;
    }
    EXPECT_GT(fewest, 100);
    EXPECT_GT(most, 1000);
}

/// Of a plane that is seen head on, a pixel's texels are known by hand.
TEST(PixelMeans, know_how_many_texels_a_pixel_covers_and_at_which_angle) {
    const Scene scene = picture_of("distant_bumps", 512, 512);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const PixelMeans one = shade_pixel(tracer, truth, 256, 420);
    // Derivatives of the floor's mapping along the pixel's column, from intersections with y = 0 by
    // the camera's rays alone.
    const auto z_at = [&](double row) {
        const glm::dvec3 way = line_of_sight(scene.camera, 256.5, row);
        return scene.camera.eye.z - scene.camera.eye.y / way.y * way.z;
    };
    const double length = std::abs(z_at(421) - z_at(420)); // along z, in the file's units
    const double texels = length * 64 * 24.3 / (2 * 29.07);
    EXPECT_NEAR(one.texels.at(256, 420), texels, 2e-3 * texels);
    const glm::dvec3 centre = line_of_sight(scene.camera, 256.5, 420.5);
    EXPECT_NEAR(one.cosine.at(256, 420), -glm::normalize(centre).y, 1e-5);
    EXPECT_EQ(one.texels.at(256, 421), 0); // no other pixel
}

TEST(PixelMeans, of_one_pixel_are_the_pictures) {
    const Scene scene = picture_of("distant_bumps", 40, 40);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const PixelMeans means = shade_pixels(tracer, truth);
    for (const auto& [x, y] : {std::pair{20, 33}, std::pair{12, 9}, std::pair{0, 0}}) {
        const PixelMeans one = shade_pixel(tracer, truth, x, y);
        EXPECT_EQ(one.color.at(x, y), means.color.at(x, y));
        EXPECT_EQ(one.rays.at(x, y), means.rays.at(x, y));
    }
}

TEST(PixelMeans, are_the_same_for_any_number_of_threads) {
    const Scene scene = picture_of("distant_bumps", 64, 48);
    const Tracer alone(scene, 1);
    const PixelMeans right = shade_pixels(alone, trace(alone));
    const Tracer many(scene, 5);
    const PixelMeans means = shade_pixels(many, trace(many));
    EXPECT_EQ(means.color.pixels, right.color.pixels);
    EXPECT_EQ(means.alike.pixels, right.alike.pixels);
    EXPECT_EQ(means.noise, right.noise);
}

TEST(PixelMeans, of_several_lights_add_them_up) {
    const Scene scene = tests::load_named("bumpy_lights-spot");
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const TracedLights before = trace_lights_before(tracer);
    ASSERT_EQ(before.size(), 1U);
    Supersampled uniform = shade_supersampled(tracer, 4, before);
    const PixelMeans means = shade_pixels(tracer, truth, before);
    int compared = 0;
    for (std::size_t i = 0; i < means.color.pixels.size(); ++i) {
        if (means.rays.pixels[i] != glm::u8vec2(4)) continue;
        EXPECT_LT(glm::distance(means.color.pixels[i], uniform.color.pixels[i]), rounding);
        ++compared;
    }
    EXPECT_GT(compared, 10000);
}

/// What it says of its own error is about what four times as many rays change, and more.
TEST(PixelMeans, know_their_noise) {
    const Scene scene = picture_of("distant_bumps", 64, 64);
    const Tracer tracer(scene);
    const GroundTruth truth = trace(tracer);
    const PixelMeans means = shade_pixels(tracer, truth);
    const Scene finer = picture_of("distant_bumps", 128, 128); // 64 x 64 rays a pixel of the other
    const Supersampled finest = shade_supersampled(Tracer(finer), 32);
    double squares = 0;
    double pixels = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            if (truth.triangle.at(x, y) == no_triangle) continue;
            glm::dvec3 mean(0);
            for (const int row : {2 * y, 2 * y + 1})
                for (const int column : {2 * x, 2 * x + 1})
                    mean += 0.25 * finest.color.at(column, row);
            const glm::dvec3 off = 255.0 * (means.color.at(x, y) - mean);
            squares += glm::dot(off, off);
            ++pixels;
        }
    const double rmse = std::sqrt(squares / (3 * pixels));
    EXPECT_LT(rmse, 1.5 * means.noise);
    EXPECT_GT(rmse, means.noise / 6);
}

} // namespace
} // namespace shadowproof
