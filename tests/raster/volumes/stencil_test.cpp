// What the counters read at pixels whose shadow depths are known by hand.
#include "raster/render.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadowproof::tests {
namespace {

constexpr const char* robust[]{"zfail_clamp", "zfail_infinite", "zfail_reversed"};
/// Right wherever eye and near plane are outside all volumes. Not zfail: what lies behind a floor
/// is in its shadow, out to the far plane.
constexpr const char* right_outside[]{"zpass", "zfail_clamp", "zfail_infinite", "zfail_reversed"};

class Stencil : public testing::Test {
protected:
    Gpu gpu{GlPlatform::osmesa};

    Frame draw(const Scene& scene, const char* technique) {
        return render(*find_technique(technique), scene, Plan{}, gpu);
    }
};

/// The counter, the claim and the triangle at a pixel.
struct Seen {
    std::uint32_t counter = 0;
    Visibility claim = Visibility::background;
    bool operator==(const Seen&) const = default;
};
void PrintTo(const Seen& seen, std::ostream* out) {
    *out << "counter " << seen.counter << ", claim " << static_cast<int>(seen.claim);
}
Seen at(const Frame& frame, const Pixel& pixel) {
    return {frame.counted->counter.at(pixel.x, pixel.y), frame.claim.at(pixel.x, pixel.y)};
}

TEST_F(Stencil, a_box_over_a_floor_counts_one_in_its_shadow_and_none_beside) {
    const Scene scene = box_over_floor();
    for (const char* technique : right_outside) {
        SCOPED_TRACE(technique);
        const Frame frame = draw(scene, technique);
        const auto seen = [&](const glm::dvec3& point) {
            return at(frame, pixel_of(scene, point));
        };
        EXPECT_EQ(seen({0, 0, 0}), (Seen{1, Visibility::shadowed})); // below the box
        EXPECT_EQ(seen({1.3, 0, 1.3}), (Seen{1, Visibility::shadowed}));
        EXPECT_EQ(seen({1.7, 0, 1.7}), (Seen{0, Visibility::lit}));
        EXPECT_EQ(seen({-5, 0, -5}), (Seen{0, Visibility::lit}));
        EXPECT_EQ(seen({0, 2, 0}), (Seen{0, Visibility::lit}));           // the box's top
        EXPECT_EQ(seen({1, 1.5, 0}), (Seen{1, Visibility::shadowed}));    // its side, turned away
        EXPECT_EQ(at(frame, {64, 0}), (Seen{0, Visibility::background})); // above the horizon
    }
}

TEST_F(Stencil, nested_boxes_count_two) {
    Scene scene = box_over_floor();
    add_box(scene, {-0.5, 1.2, -0.5}, {0.5, 1.8, 0.5});
    for (const char* technique : right_outside) {
        SCOPED_TRACE(technique);
        const Frame frame = draw(scene, technique);
        EXPECT_EQ(at(frame, pixel_of(scene, {0, 0, 0})), (Seen{2, Visibility::shadowed}));
        EXPECT_EQ(at(frame, pixel_of(scene, {1.2, 0, 1.2})), (Seen{1, Visibility::shadowed}));
        EXPECT_EQ(at(frame, pixel_of(scene, {3, 0, 3})), (Seen{0, Visibility::lit}));
    }
}

TEST_F(Stencil, a_back_side_is_shadowed_with_a_counter_of_its_own) {
    // A two-sided wall between light and eye: unlit on the eye's side, and by itself alone.
    Scene scene = empty_scene();
    scene.materials[0].double_sided = true;
    scene.lights[0].position = {0, 0, -5};
    add_rectangle(scene, {1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0});
    for (const char* technique : robust)
        EXPECT_EQ(at(draw(scene, technique), {32, 32}), (Seen{1, Visibility::shadowed}))
            << technique;
}

TEST_F(Stencil, a_single_sided_wall_seen_from_behind_is_not_seen_but_casts) {
    // Light, second wall, first wall, eye: the first wall's front is turned to the light.
    Scene scene = empty_scene();
    scene.lights[0].position = {0, 0, -5};
    add_rectangle(scene, {1, -1, -2}, {-1, -1, -2}, {-1, 1, -2}, {1, 1, -2});
    scene.materials.push_back({.name = "two-sided", .double_sided = true});
    add_rectangle(scene, {-3, -3, -4}, {3, -3, -4}, {3, 3, -4}, {-3, 3, -4});
    for (const char* technique : robust) {
        SCOPED_TRACE(technique);
        const Frame frame = draw(scene, technique);
        EXPECT_GE(frame.triangle.at(32, 32), 2U); // the second wall, through the first
        EXPECT_LT(frame.triangle.at(32, 32), 4U);
        EXPECT_EQ(at(frame, {32, 32}).claim, Visibility::shadowed);
        EXPECT_EQ(at(frame, {32, 32}).counter, 0U); // nothing before it and the light
    }
}

TEST_F(Stencil, a_surface_behind_its_own_back_face_is_counted_through_the_light_cap) {
    // A single-sided roof, front up, below the light; the eye, under it, sees the ceiling through
    // it: its rays leave the volume through the light cap, and nothing else.
    Scene scene = empty_scene();
    scene.lights[0].position = {0, 3, 0};
    add_rectangle(scene, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1});
    scene.materials.push_back({.name = "two-sided", .double_sided = true});
    add_rectangle(scene, {-9, 4, 9}, {9, 4, 9}, {9, 4, -9}, {-9, 4, -9});
    look_at(scene.camera, {0.1, -1, 0.2}, {0, 4, 0});
    const Pixel through_the_roof = pixel_of(scene, {0, 4, 0});
    // s(ceiling) - s(near) = 0 - 1: the eye is below the roof, inside its volume.
    EXPECT_EQ(at(draw(scene, "zpass"), through_the_roof), (Seen{255, Visibility::shadowed}));
    for (const char* technique : robust)
        EXPECT_EQ(at(draw(scene, technique), through_the_roof), (Seen{0, Visibility::lit}))
            << technique;
}

TEST_F(Stencil, an_eye_inside_a_volume_miscounts_with_zpass_and_never_with_zfail) {
    Scene scene = box_over_floor();
    look_at(scene.camera, {0.3, 0.5, 0.2}, {6, 0, 6});
    const Pixel lit = pixel_of(scene, {5, 0, 5});
    const Pixel shadowed = pixel_of(scene, {1.2, 0, 1.2});
    const Frame zpass = draw(scene, "zpass");
    EXPECT_EQ(at(zpass, lit), (Seen{255, Visibility::shadowed}));
    EXPECT_EQ(at(zpass, shadowed), (Seen{0, Visibility::lit}));
    for (const char* technique : robust) {
        const Frame frame = draw(scene, technique);
        EXPECT_EQ(at(frame, lit), (Seen{0, Visibility::lit})) << technique;
        EXPECT_EQ(at(frame, shadowed), (Seen{1, Visibility::shadowed})) << technique;
    }
}

TEST_F(Stencil, a_near_plane_inside_a_volume_miscounts_with_zpass_and_never_with_zfail) {
    Scene scene = box_over_floor();
    look_at(scene.camera, {4, 0.5, 0}, {0, 0.5, 0});
    scene.camera.near = 3; // at x = 1; the volume is 1.4 wide there
    const Pixel behind = pixel_of(scene, {-5, 0, 0});
    EXPECT_EQ(at(draw(scene, "zpass"), behind), (Seen{255, Visibility::shadowed}));
    for (const char* technique : {"zfail", "zfail_clamp", "zfail_infinite", "zfail_reversed"})
        EXPECT_EQ(at(draw(scene, technique), behind), (Seen{0, Visibility::lit})) << technique;
}

TEST_F(Stencil, a_far_plane_inside_a_volume_miscounts_with_zfail_and_never_when_it_does_not_clip) {
    Scene scene = box_over_floor();
    look_at(scene.camera, {6, 0.5, 0}, {0, 0.5, 0});
    scene.camera.far = 6; // at x = 0, where the ray is below floor and box, in both volumes
    const Pixel before = pixel_of(scene, {2, 0, 0});
    EXPECT_EQ(at(draw(scene, "zfail"), before), (Seen{254, Visibility::shadowed}));
    EXPECT_EQ(at(draw(scene, "zpass"), before), (Seen{0, Visibility::lit}));
    for (const char* technique : robust)
        EXPECT_EQ(at(draw(scene, technique), before), (Seen{0, Visibility::lit})) << technique;
}

TEST_F(Stencil, no_technique_shows_what_lies_before_the_near_or_beyond_the_far_plane) {
    Scene scene = empty_scene();
    add_rectangle(scene, {-9, -9, 4}, {0, -9, 4}, {0, 9, 4}, {-9, 9, 4});   // depth 1, on the left
    add_rectangle(scene, {-9, -9, 0}, {9, -9, 0}, {9, 0, 0}, {-9, 0, 0});   // depth 5, below
    add_rectangle(scene, {-9, 0, -4}, {9, 0, -4}, {9, 9, -4}, {-9, 9, -4}); // depth 9, above
    scene.camera.near = 2;
    scene.camera.far = 8;
    for (const Technique& technique : all_techniques()) {
        if (!suits(technique, scene)) continue;
        SCOPED_TRACE(technique.name);
        const Frame frame = render(technique, scene, Plan{}, gpu);
        const auto seen = [&](int x, int y) {
            return frame.rays ? frame.rays->pixels.at(x, y).seen : frame.triangle.at(x, y);
        };
        EXPECT_EQ(seen(16, 16), no_triangle);
        EXPECT_EQ(frame.claim.at(16, 16), Visibility::background);
        EXPECT_EQ(seen(48, 16), no_triangle);
        EXPECT_TRUE(seen(16, 48) == 2 || seen(16, 48) == 3);
    }
}

TEST_F(Stencil, the_background_counts_at_infinity_or_at_the_far_plane) {
    Scene scene = empty_scene();
    scene.lights[0].position = {0, 6, 0};
    add_box(scene, {-1, 1, -1}, {1, 2, 1});
    add_box(scene, {-0.5, 1.2, -0.5}, {0.5, 1.8, 0.5});
    look_at(scene.camera, {3, 8, 0.5}, {3, 0, 0});
    // Straight down beside the boxes: from the light, that direction meets both tops.
    const Pixel down = pixel_of(scene, {3.02, -92, 0.53});
    EXPECT_EQ(at(draw(scene, "zfail_infinite"), down), (Seen{2, Visibility::background}));
    EXPECT_EQ(at(draw(scene, "zfail_reversed"), down), (Seen{2, Visibility::background}));
    // The far plane, 1.5 times as deep as the boxes, is not that far: the volume is 2.2 wide.
    EXPECT_EQ(at(draw(scene, "zfail_clamp"), down), (Seen{0, Visibility::background}));
    EXPECT_EQ(at(draw(scene, "zfail"), down), (Seen{0, Visibility::background}));
    EXPECT_EQ(at(draw(scene, "zpass"), down), (Seen{0, Visibility::background}));
}

TEST_F(Stencil, three_hundred_casters_wrap_the_counter) {
    Scene scene = empty_scene();
    scene.lights[0].position = {0, 0, 4};
    look_at(scene.camera, {6, 0, 1}, {-0.9, 0, -2}); // past the edges of all casters
    for (int i = 0; i < 300; ++i) {
        const float z = static_cast<float>(i) / 300;
        add_rectangle(scene, {-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z});
    }
    add_rectangle(scene, {-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2});
    const Pixel pixel = pixel_of(scene, {-0.9, 0, -2});
    for (const char* technique : robust)
        EXPECT_EQ(at(draw(scene, technique), pixel), (Seen{300 - 256, Visibility::shadowed}))
            << technique;
}

TEST_F(Stencil, of_two_triangles_that_tie_only_the_seen_one_is_lit) {
    // The same two-sided rectangle twice, wound both ways: one of them is seen, both are lit sides.
    Scene scene = empty_scene();
    scene.materials[0].double_sided = true;
    add_rectangle(scene, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    add_rectangle(scene, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0});
    for (const char* technique : right_outside)
        EXPECT_EQ(at(draw(scene, technique), {30, 33}), (Seen{0, Visibility::lit})) << technique;
}

TEST_F(Stencil, the_dark_cap_has_its_depth_at_infinity_exactly) {
    // Looking from the light along the volume, only the dark cap closes it; it must not be clipped.
    Scene scene = empty_scene();
    scene.lights[0].position = {0.1, 0.2, 5.5};
    add_box(scene, {-1, -1, -1}, {1, 1, 1});
    look_at(scene.camera, {0.13, 0.21, 7}, {-0.03, 0.05, -1});
    for (const char* technique : {"zfail_infinite", "zfail_reversed"}) {
        const Frame frame = draw(scene, technique);
        EXPECT_EQ(at(frame, {32, 32}), (Seen{0, Visibility::lit})) << technique;
    }
}

TEST_F(Stencil, the_robust_techniques_differ_at_silhouettes_alone) {
    const Scene scene = box_over_floor();
    const Frame first = draw(scene, robust[0]);
    const auto at_silhouette = [&](int x, int y) {
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, first.claim.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, first.claim.width - 1); ++u)
                if (first.claim.at(u, v) != first.claim.at(x, y)) return true;
        return false;
    };
    for (const char* technique : robust) {
        const Frame frame = draw(scene, technique);
        for (int y = 0; y < frame.claim.height; ++y) {
            for (int x = 0; x < frame.claim.width; ++x) {
                const bool same = frame.claim.at(x, y) == first.claim.at(x, y);
                EXPECT_TRUE(same || at_silhouette(x, y)) << technique << " " << x << "," << y;
            }
        }
    }
}

} // namespace
} // namespace shadowproof::tests
