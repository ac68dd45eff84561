// What areas of a picture tell is what rays through their pixels see.
#include "reference/trace/areas.h"
#include "scenes/load/catalog.h"
#include "tests/raster/masked_scene.h"
#include "tests/reference/hard_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

/// The six faces of a cube around the eye, and one that is turned and is no square.
std::vector<Camera> cameras(const Camera& eye, int size) {
    std::vector<Camera> all;
    for (const double sign : {-1.0, 1.0})
        for (int axis = 0; axis < 3; ++axis) {
            Camera camera = eye;
            const std::array<glm::dvec3, 3> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                                 glm::dvec3(0, 0, 1)};
            const auto at = [&](int k) { return axes[static_cast<std::size_t>((axis + k) % 3)]; };
            camera.forward = sign * at(0);
            camera.right = at(1);
            camera.up = -sign * at(2);
            camera.half_height = 1;
            camera.width = camera.height = size;
            all.push_back(camera);
        }
    Camera turned = eye;
    turned.forward = {0.36, -0.48, -0.8};
    turned.right = {0.8, 0.6, 0};
    turned.up = {0.48, -0.64, 0.6};
    turned.half_height = 0.7;
    turned.width = size + 37;
    turned.height = size - 5;
    all.push_back(turned);
    return all;
}

struct Told {
    std::size_t pixels = 0;
    std::size_t of = 0;
    std::size_t empty = 0; ///< of those that are told
};

/// Every pixel that is told against its ray.
Told told(const Tracer& tracer, const SeenRange& range, const Camera& camera) {
    Areas areas(camera.width, camera.height);
    std::vector<glm::dvec3> rays;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            areas.ask(x, y);
            rays.push_back(line_of_sight(camera, x + 0.5, y + 0.5));
        }
    Areas::divide(std::span(&areas, 1), std::span(&camera, 1), tracer);
    std::vector<std::uint32_t> seen(rays.size());
    see_triangles(
        tracer, range, rays.size(), [&](std::size_t i) { return rays[i]; },
        [&](std::size_t i, std::uint32_t triangle) { seen[i] = triangle; });
    Told result{.of = rays.size()};
    int wrong = 0;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const std::uint32_t shows = areas.at(x, y);
            if (shows == Areas::untold) continue;
            ++result.pixels;
            result.empty += shows == no_triangle ? 1 : 0;
            if (shows != seen[static_cast<std::size_t>(y * camera.width + x)] && wrong++ == 0)
                ADD_FAILURE() << x << ", " << y << " shows " << shows << ", and its ray sees "
                              << seen[static_cast<std::size_t>(y * camera.width + x)];
        }
    EXPECT_EQ(wrong, 0);
    return result;
}

/// As the scene's camera is, and with planes that cut through what it sees.
Told told(Scene scene, int size) {
    Told sum;
    const auto add = [&](const Tracer& tracer) {
        for (const Camera& camera : cameras(scene.camera, size)) {
            const Told one = told(tracer, range_of(scene.camera), camera);
            sum.pixels += one.pixels;
            sum.of += one.of;
            sum.empty += one.empty;
        }
    };
    add(Tracer(scene));
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
    for (const glm::vec3& position : scene.positions) {
        const double away = glm::distance(glm::dvec3(position), scene.camera.eye);
        nearest = std::min(nearest, away);
        farthest = std::max(farthest, away);
    }
    scene.camera.near = 0.75 * nearest + 0.25 * farthest;
    scene.camera.far = 0.25 * nearest + 0.75 * farthest;
    add(Tracer(scene));
    return sum;
}

class AreasOfHardScene : public testing::TestWithParam<HardScene> {};

TEST_P(AreasOfHardScene, tell_what_rays_see) {
    EXPECT_GT(told(GetParam().make(), 61).pixels, 0U);
}

INSTANTIATE_TEST_SUITE_P(Reference, AreasOfHardScene, testing::ValuesIn(hard_scenes()),
                         [](const auto& scene) {
                             std::string name = scene.param.name;
                             for (char& c : name)
                                 if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                             return name;
                         });

/// Few triangles fill most of the picture: hardly a ray is needed.
TEST(Areas, of_few_triangles_tell_nearly_all) {
    Scene scene = empty_scene(4);
    add_box(scene, {-3, -2, -9}, {1, 1, -4});
    add_box(scene, {-0.5F, -0.5F, -3}, {0.5F, 0.25F, -2});
    finish(scene, false);
    const Told found = told(scene, 128);
    EXPECT_GT(found.pixels, found.of * 97 / 100);
    EXPECT_GT(found.empty, found.of / 2);
    EXPECT_LT(found.empty, found.pixels);
}

TEST(Areas, leave_triangles_with_masks_to_rays) {
    std::size_t pixels = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
        pixels += told(tests::masked_scene(seed), 96).pixels;
    EXPECT_GT(pixels, 0U);
}

/// Two equal triangles at one place, and two that cross within a pixel of each other, are told
/// where bounds tell them apart, and nowhere else.
TEST(Areas, leave_ties_to_rays) {
    Scene scene = empty_scene(4);
    for (int i = 0; i < 2; ++i) add_triangle(scene, {-8, -8, -4}, {8, -8, -4}, {0, 8, -4});
    add_triangle(scene, {-8, -8, -4.5F}, {8, -8, -3.5F}, {0, 8, -4});
    finish(scene, true);
    const Told found = told(scene, 128);
    EXPECT_GT(found.pixels, found.of / 2);
}

/// Triangles in one plane, whose inverse depths come out otherwise for each by roundings alone: the
/// first is seen, however they come out.
TEST(Areas, leave_triangles_in_one_plane_to_rays) {
    Scene scene = empty_scene(4);
    const auto at = [](int i, int j) { return glm::vec3(2 * i + 3 * j, -i, -7 - j); };
    for (int i = 0; i < 4; ++i) {
        add_triangle(scene, at(-9 + i, -5), at(9, 3 + i), at(-4 - i, 6));
        add_triangle(scene, at(7, -4 - i), at(-8 + i, 5), at(-6, -5 - i));
    }
    finish(scene, true);
    scene.camera.eye = {0.1, 0.2, 0.3};
    const Told found = told(scene, 128);
    EXPECT_GT(found.empty, 0U);
    EXPECT_LT(found.pixels, found.of);
}

TEST(Areas, of_bundled_scenes_tell_what_rays_see) {
    for (const char* name : {"ordinary", "light_on_edge", "overlapping", "spot", "perforated"}) {
        SCOPED_TRACE(name);
        EXPECT_GT(told(load_scene(name, {}), 320).pixels, 0U);
    }
}

/// Where triangles are more than pixels are worth, nothing is told.
TEST(Areas, are_not_worth_it_where_triangles_are_many) {
    const Scene scene = load_scene("ordinary", {});
    const Tracer tracer(scene);
    EXPECT_FALSE(Areas::are_worth(tracer, scene.triangles.size()));
    EXPECT_TRUE(Areas::are_worth(tracer, 8 * scene.triangles.size()));
}

} // namespace
} // namespace shadowproof
