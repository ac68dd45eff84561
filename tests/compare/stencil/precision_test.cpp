// To which depth a technique's numbers suffice, and that `precision` nearer than that needs a
// reason.
#include "compare/driver/error_bounds.h"
#include "compare/driver/sufficient_depths.h"
#include "compare/stencil/precision_check.h"
#include "compare/verdict.h"
#include "scenes/load/catalog.h"
#include "scenes/stress/parameter.h"
#include "tests/compare/traced_bundled.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace shadowproof::tests {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Eye and light in the origin: no coordinate adds to the float transform's errors but depth's own.
Scene at_origin(double near) {
    Scene scene;
    scene.camera.near = near;
    scene.camera.far = 1000 * near;
    scene.lights.emplace_back();
    return scene;
}

double width_of_pixel(const Camera& camera) {
    return 2 * camera.half_height / camera.height;
}

TEST(SufficientDepths, of_fixed_point_are_as_many_near_planes_as_pixels_are_wide_quanta) {
    const Scene scene = at_origin(0.1);
    const double pixel = width_of_pixel(scene.camera);
    const SufficientDepths depths = sufficient_depths(
        scene, {.projection = DepthModel::Projection::infinite, .near = scene.camera.near});
    EXPECT_EQ(depths.nearest, 0.1);
    // 2^-20 t^2 / near for the window, 10 2^-24 t (t / near) for the transform of places, and
    // 10 2^-24 t for that of directions, as eye and light are at distance t
    EXPECT_NEAR(depths.furthest, 0.1 * (pixel * 0x1p24 - 10) / 26, 1e-9);
    const SufficientDepths twice = sufficient_depths(
        at_origin(0.2), {.projection = DepthModel::Projection::infinite, .near = 0.2});
    EXPECT_NEAR(twice.furthest, 2 * depths.furthest, 1e-9);
}

TEST(SufficientDepths, of_reversed_floats_have_no_end) {
    const Scene scene = at_origin(1e-6);
    const SufficientDepths depths =
        sufficient_depths(scene, {.projection = DepthModel::Projection::infinite_reversed,
                                  .near = 1e-6,
                                  .floating = true,
                                  .eye_relative = true});
    EXPECT_EQ(depths.nearest, 1e-6);
    EXPECT_EQ(depths.furthest, infinity);
    EXPECT_EQ(words_of(depths, 1e-6, 1), "at any depth");
}

TEST(SufficientDepths, far_from_the_origin_begin_some_way_off_or_nowhere) {
    Scene scene = at_origin(0.1);
    scene.camera.eye = {0, 0, 1e4};
    scene.lights.front().position = scene.camera.eye;
    const DepthModel reversed{
        .projection = DepthModel::Projection::infinite_reversed, .near = 0.1, .floating = true};
    const SufficientDepths far_off = sufficient_depths(scene, reversed);
    // 10 2^-24 of eye and point, some 2e4, and 2^-20 t: a pixel's width from here
    EXPECT_NEAR(far_off.nearest, 2e5 * 0x1p-24 / (width_of_pixel(scene.camera) - 0x1p-20), 1e-6);
    EXPECT_EQ(far_off.furthest, infinity);
    const DepthModel infinite{.projection = DepthModel::Projection::infinite, .near = 0.1};
    const SufficientDepths both = sufficient_depths(scene, infinite);
    for (const double t : {0.1, 1.0, 5.0, 50.0, 500.0, 5e4}) {
        const bool suffices =
            depth_error(scene, infinite, {0, 0, 1e4 - t}) <= t * width_of_pixel(scene.camera);
        EXPECT_EQ(both.contains(t), suffices) << t;
    }
    scene.camera.eye.z = scene.lights.front().position.z = 1e9;
    EXPECT_EQ(words_of(sufficient_depths(scene, infinite), 0.1, 1), "at no depth");
}

TEST(SufficientDepths, that_list_states_are_of_the_numbers_that_are_drawn_with) {
    Gpu gpu(GlPlatform::osmesa);
    for (const char* name : {"ordinary", "bumpy_sphere"}) {
        const TracedScene& traced = traced_bundled(name);
        for (const Technique& technique : all_techniques()) {
            if (!suits(technique, traced.scene)) continue;
            const Frame frame = render(technique, traced.scene, traced.plan, gpu);
            ASSERT_EQ(technique.depth_model != nullptr, frame.counted.has_value())
                << technique.name;
            if (technique.depth_model == nullptr) continue;
            const SufficientDepths stated =
                sufficient_depths(traced.scene, technique.depth_model(traced.scene));
            const SufficientDepths drawn = sufficient_depths(traced.scene, frame.depth_model);
            EXPECT_EQ(stated.nearest, drawn.nearest) << technique.name;
            EXPECT_EQ(stated.furthest, drawn.furthest) << technique.name;
        }
    }
}

/// The claim of a frame whose counter is wrong at one pixel.
struct WrongAt {
    Frame frame;
    PixelPlace place;

    WrongAt(const Frame& right, PixelPlace p) : frame(right), place(p) {
        const bool was_lit = right.claim.at(p.x, p.y) == Visibility::lit;
        frame.counted->counter.at(p.x, p.y) = was_lit ? 1 : 0;
        frame.claim.at(p.x, p.y) = was_lit ? Visibility::shadowed : Visibility::lit;
    }

    bool is_too_near(const TracedScene& traced, const SufficientDepths& sufficient) const {
        const Prediction prediction = prediction_of(traced, frame);
        const CountedClaim claim{
            {traced.traced, frame}, prediction, receiving_triangles(traced.scene), sufficient};
        return shadowproof::is_too_near(claim, place);
    }
};

/// What the pixels up to `reach` away show, compared with the pixel's own triangle and claim.
struct Around {
    bool some_as_claimed = false;
    bool all_as_now = true;
};

Around around(const Frame& frame, PixelPlace p, int reach) {
    Around found;
    for (int y = p.y - reach; y <= p.y + reach; ++y)
        for (int x = p.x - reach; x <= p.x + reach; ++x) {
            const bool same_surface = frame.triangle.at(x, y) == frame.triangle.at(p.x, p.y);
            const bool same_claim = frame.claim.at(x, y) == frame.claim.at(p.x, p.y);
            found.some_as_claimed |= same_surface && !same_claim;
            found.all_as_now &= same_surface && same_claim;
        }
    return found;
}

/// Whether the faces of volumes are the same all around the pixel, and none is near the surface.
bool is_alike_all_around(const TracedScene& traced, PixelPlace p) {
    const PixelRecord centre = record_pixel(traced.traced, p.x, p.y);
    if (centre.depth_margin.value_or(infinity) < 0.3) return false;
    for (const int y : {p.y - 2, p.y, p.y + 2})
        for (const int x : {p.x - 2, p.x, p.x + 2})
            if (record_pixel(traced.traced, x, y).ledger.crossings.size() !=
                centre.ledger.crossings.size())
                return false;
    return true;
}

TEST(Precision, is_too_near_where_no_face_of_a_volume_meets_the_surface_within_a_pixel) {
    const TracedScene& traced = traced_bundled("ordinary");
    Gpu gpu(GlPlatform::osmesa);
    const Frame frame = render(*find_technique("zfail"), traced.scene, traced.plan, gpu);
    const SufficientDepths sufficient = sufficient_depths(traced.scene, frame.depth_model);
    const SufficientDepths insufficient{infinity, -infinity};
    int far_from_any = 0;
    int beside_one = 0;
    const int margin = 3;
    for (int y = margin; y < frame.claim.height - margin; y += 3)
        for (int x = margin; x < frame.claim.width - margin; x += 3) {
            const PixelPlace p{x, y};
            if (frame.claim.at(x, y) == Visibility::background) continue;
            // On what faces away from the light no counter makes light.
            if (!sides_of(traced.tracer, frame.triangle.at(x, y)).faces_light()) continue;
            const WrongAt wrong(frame, p);
            if (around(frame, p, 3).all_as_now && is_alike_all_around(traced, p)) {
                ++far_from_any;
                EXPECT_TRUE(wrong.is_too_near(traced, sufficient)) << x << ' ' << y;
                EXPECT_FALSE(wrong.is_too_near(traced, insufficient)) << x << ' ' << y;
            } else if (around(frame, p, 1).some_as_claimed) {
                ++beside_one;
                EXPECT_FALSE(wrong.is_too_near(traced, sufficient)) << x << ' ' << y;
            }
        }
    EXPECT_GT(far_from_any, 100);
    EXPECT_GT(beside_one, 10);
}

/// From straight above: a floor that has one depth, and on it the end of a box's shadow, where the
/// side of the volume comes down at an angle of 25 degrees, from a light that is lower than 45.
Scene low_sun_from_above(double near) {
    Scene scene = box_over_floor();
    scene.lights.front().position = {-12, 8, 0};
    Camera& camera = scene.camera;
    camera.width = camera.height = 64;
    camera.eye = {5.3, 8, 0.013};
    camera.forward = {0, -1, 0};
    camera.right = {1, 0, 0};
    camera.up = {0, 0, -1};
    camera.near = near;
    return scene;
}

/// Such a picture by zpass whose counter is wrong at one pixel, judged.
struct JudgedFromAbove {
    Comparison comparison;
    Verdict verdict = Verdict::agrees;
    bool excuses_precision = false;
};

JudgedFromAbove judged_from_above(double near, std::optional<PixelPlace> wrong_at) {
    constexpr std::array excused{Cause::precision};
    Gpu gpu(GlPlatform::osmesa);
    const TracedScene traced(low_sun_from_above(near));
    Frame frame = render(*find_technique("zpass"), traced.scene, traced.plan, gpu);
    EXPECT_TRUE(sufficient_depths(traced.scene, frame.depth_model).contains(8)); // the floor's
    if (wrong_at) frame = WrongAt(frame, *wrong_at).frame;
    JudgedFromAbove judged{.comparison = compared(traced, frame)};
    judged.verdict = judge(traced.scene, excused, {}, judged.comparison);
    judged.excuses_precision =
        !excused_causes(traced.scene, excused, {}, judged.comparison).empty();
    return judged;
}

/// The shadow ends between pixels 31 and 32, and with it the depths of side and floor part. Pixel
/// 33 is further than a pixel from there, yet while depths are off by enough, those of side and
/// floor may be stored there in either order. If they are off by more, they are so all over the
/// pixel's surroundings, which is a reason; if by less, the order is known.
TEST(Precision, that_is_too_near_makes_a_cell_a_defect) {
    const PixelPlace beside{32, 28};
    const PixelPlace further{33, 28};
    const auto cause_at = [](const JudgedFromAbove& judged, PixelPlace p) {
        return judged.comparison.cause.at(p.x, p.y);
    };
    constexpr auto precision = static_cast<std::uint8_t>(Cause::precision);
    for (const double near : {6.5e-4, 8.2e-4, 9.5e-4}) {
        SCOPED_TRACE(near);
        const JudgedFromAbove right = judged_from_above(near, std::nullopt);
        EXPECT_EQ(right.comparison.too_near, 0U);
        EXPECT_TRUE(right.verdict == Verdict::agrees ||
                    right.verdict == Verdict::fails_as_predicted);
        const JudgedFromAbove at_border = judged_from_above(near, beside);
        EXPECT_EQ(cause_at(at_border, beside), precision);
        EXPECT_EQ(at_border.comparison.too_near, 0U);
        EXPECT_EQ(at_border.verdict, Verdict::fails_as_predicted);
        EXPECT_TRUE(at_border.excuses_precision);
    }
    const JudgedFromAbove coarse = judged_from_above(6.5e-4, further);
    EXPECT_EQ(cause_at(coarse, further), precision);
    EXPECT_EQ(coarse.comparison.too_near, 0U);
    EXPECT_EQ(coarse.verdict, Verdict::fails_as_predicted);
    const JudgedFromAbove caught = judged_from_above(8.2e-4, further);
    EXPECT_EQ(cause_at(caught, further), precision);
    EXPECT_EQ(caught.comparison.too_near, 1U);
    EXPECT_EQ(caught.verdict, Verdict::defect);
    EXPECT_FALSE(caught.excuses_precision);
    EXPECT_EQ(judged_from_above(9.5e-4, further).verdict, Verdict::unexplained);
}

TEST(Precision, of_near_planes_close_to_the_eye_begins_where_the_numbers_end) {
    SceneRequest request;
    request.width = request.height = 64;
    const TracedScene traced(stressed(load_scene("ordinary", request), {"near_plane", 1e-5}));
    Gpu gpu(GlPlatform::osmesa);
    for (const char* technique : {"zfail", "zfail_infinite", "zpass"}) {
        const Frame frame = render(*find_technique(technique), traced.scene, traced.plan, gpu);
        const Comparison comparison = compared(traced, frame);
        EXPECT_GT(pixels_of(comparison, Cause::precision), 0U) << technique;
        EXPECT_EQ(comparison.too_near, 0U) << technique;
        const SufficientDepths sufficient = sufficient_depths(traced.scene, frame.depth_model);
        double nearest = infinity;
        for (const double depth : traced.truth.depth.pixels) nearest = std::min(nearest, depth);
        EXPECT_LT(sufficient.furthest, nearest) << technique;
    }
    EXPECT_EQ(pixels_of(compared(traced, "zfail_reversed", gpu), Cause::precision), 0U);
}

} // namespace
} // namespace shadowproof::tests
