// What traced techniques fail at, each failing beside the setting that mends it, and faults in
// their rays, each of which must be caught.
#include "compare/verdict.h"
#include "raster/traced/shadow_rays.h"
#include "scenes/error.h"
#include "tests/compare/traced_bundled.h"
#include "tests/raster/small_scenes.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace shadowproof {
namespace {

using tests::compared;
using tests::pixels_of;
using tests::traced_bundled;
using tests::TracedScene;

class Traced : public testing::Test {
protected:
    static Comparison with_epsilon(const std::string& name, double epsilon) {
        const TracedScene& scene = traced_bundled(name);
        Plan plan = scene.plan;
        plan.asked.rays.epsilon = epsilon;
        return explained(scene, epsilon_recipe(scene.scene, plan));
    }
    static Comparison with_offset(const std::string& name, double offset) {
        const TracedScene& scene = traced_bundled(name);
        Plan plan = scene.plan;
        plan.asked.rays.offset = offset;
        return explained(scene, offset_recipe(scene.scene, plan));
    }
    static Comparison explained(const TracedScene& scene, const RayRecipe& recipe) {
        const Comparison comparison = compared(scene, trace_shadow_rays(scene.scene, recipe));
        EXPECT_EQ(pixels_of(comparison, Cause::unexplained), 0U);
        EXPECT_EQ(comparison.evidence.unexplained, 0U) << comparison.summary.words;
        EXPECT_EQ(pixels_of(comparison, Cause::edge), 0U);
        return comparison;
    }
};

TEST_F(Traced, a_constant_too_large_leaks_and_a_smaller_one_mends_it) {
    EXPECT_GT(pixels_of(with_epsilon("in_metres", 1e-3), Cause::leak), 50U);
    EXPECT_EQ(pixels_of(with_epsilon("in_metres", 1e-7), Cause::leak), 0U);
    EXPECT_GT(pixels_of(with_offset("in_metres", 1e-3), Cause::leak), 100U);
    EXPECT_LE(pixels_of(with_offset("in_metres", 1e-7), Cause::leak), 2U); // of 680
}

TEST_F(Traced, a_constant_too_small_shows_acne_and_a_larger_one_mends_it) {
    EXPECT_GT(pixels_of(with_epsilon("in_millimetres", 1e-3), Cause::acne), 1000U);
    EXPECT_EQ(pixels_of(with_epsilon("in_millimetres", 200), Cause::acne), 0U);
    EXPECT_GT(pixels_of(with_offset("in_millimetres", 1e-3), Cause::acne), 100U);
    EXPECT_EQ(pixels_of(with_offset("in_millimetres", 1), Cause::acne), 0U);
}

TEST_F(Traced, without_an_epsilon_there_is_acne_and_no_leak) {
    const Comparison bare = with_epsilon("ordinary", 0);
    EXPECT_GT(pixels_of(bare, Cause::acne), 1000U);
    EXPECT_EQ(pixels_of(bare, Cause::leak), 0U);
    const Comparison skipping = explained(traced_bundled("ordinary"), skip_recipe());
    EXPECT_LT(pixels_of(skipping, Cause::acne), pixels_of(bare, Cause::acne) / 10);
    EXPECT_EQ(pixels_of(skipping, Cause::leak), 0U);
}

TEST_F(Traced, rays_slip_through_between_slivers) {
    EXPECT_GT(pixels_of(with_epsilon("slivers", 1e-3), Cause::missed), 0U);
}

/// Whatever Embree computes with: where it fuses products with sums, other rays slip through.
TEST_F(Traced, the_bounds_hold_on_every_instruction_set) {
    constexpr const char* variable = "SHADOWPROOF_TEST_TRACED_INSTRUCTION_SET";
    const TracedScene& scene = traced_bundled("slivers");
    for (const char* set : {"sse2", "sse4.2", "avx", "avx2", "avx512"}) {
        SCOPED_TRACE(set);
        setenv(variable, set, 1);
        try {
            explained(scene, epsilon_recipe(scene.scene, scene.plan));
            explained(scene, skip_recipe());
        } catch (const Error& error) {
            EXPECT_STRNE(set, "sse2") << error.what(); // the processor lacks another
        }
    }
    setenv(variable, "mmx", 1);
    EXPECT_THROW(explained(scene, skip_recipe()), Error);
    unsetenv(variable);
}

/// The same picture in metres and in millimetres: the constants must change with the unit.
TEST_F(Traced, a_constant_that_suits_one_unit_does_not_suit_another) {
    const Comparison small = with_epsilon("in_metres", 1e-6);
    const Comparison large = with_epsilon("in_millimetres", 1e-6);
    EXPECT_LT(small.differing * 10, large.differing);
}

/// Techniques that do not do what they say of themselves.
struct Fault {
    const char* name;
    const char* scene;
    RayRecipe (*recipe)(const Scene& scene, const Plan& plan);
};

FloatRay mirrored_light(const RayModel& model, const RoundedHit& hit, const Light& light) {
    Light wrong = light;
    wrong.position.x = -light.position.x;
    return shadow_ray(model, hit, wrong);
}
FloatRay too_short(const RayModel& model, const RoundedHit& hit, const Light& light) {
    FloatRay ray = shadow_ray(model, hit, light);
    ray.far *= 0.25F;
    return ray;
}
FloatRay too_long(const RayModel& model, const RoundedHit& hit, const Light& light) {
    FloatRay ray = shadow_ray(model, hit, light);
    ray.far *= 2;
    return ray;
}
FloatRay wrong_side(const RayModel& model, const RoundedHit& hit, const Light& light) {
    return shadow_ray(model, {hit.point, -hit.normal}, light);
}
FloatRay without_epsilon(const RayModel& model, const RoundedHit& hit, const Light& light) {
    FloatRay ray = shadow_ray(model, hit, light);
    ray.near = 0;
    return ray;
}
FloatRay not_a_unit(const RayModel& model, const RoundedHit& hit, const Light& light) {
    FloatRay ray = shadow_ray(model, hit, light);
    ray.direction *= ray.far; // so that the epsilon is a share of the way
    ray.far = 1;
    return ray;
}
/// An unsound widening: one unit in the last place of the starting point.
FloatRay a_bit_off(const RayModel& model, const RoundedHit& hit, const Light& light) {
    RoundedHit moved = hit;
    moved.point.x = std::nextafter(hit.point.x, 1e9F);
    return shadow_ray(model, moved, light);
}

template <RayRecipe (*right)(const Scene&, const Plan&),
          FloatRay (*ray)(const RayModel&, const RoundedHit&, const Light&)>
RayRecipe aimed(const Scene& scene, const Plan& plan) {
    RayRecipe recipe = right(scene, plan);
    recipe.shadow_ray = ray;
    return recipe;
}
RayRecipe own_not_skipped(const Scene& /*scene*/, const Plan& /*plan*/) {
    RayRecipe recipe = skip_recipe();
    recipe.skips_own = false;
    return recipe;
}
RayRecipe sides_alike(const Scene& scene, const Plan& plan) {
    RayRecipe recipe = epsilon_recipe(scene, plan);
    recipe.tells_sides_apart = false;
    return recipe;
}
RayRecipe skips_in_secret(const Scene& scene, const Plan& plan) {
    RayRecipe recipe = epsilon_recipe(scene, plan);
    recipe.model.distance = 0;
    recipe.skips_own = true;
    return recipe;
}
RayRecipe other_epsilon(const Scene& scene, const Plan& plan) {
    RayRecipe recipe = epsilon_recipe(scene, plan);
    recipe.shadow_ray = [](const RayModel& model, const RoundedHit& hit, const Light& light) {
        RayModel larger = model;
        larger.distance *= 10;
        return shadow_ray(larger, hit, light);
    };
    return recipe;
}

const Fault faults[]{
    {"mirrored_light", "ordinary", aimed<epsilon_recipe, mirrored_light>},
    {"too_short", "ordinary", aimed<epsilon_recipe, too_short>},
    {"too_long", "ordinary", aimed<offset_recipe, too_long>},
    {"wrong_side", "ordinary", aimed<offset_recipe, wrong_side>},
    {"without_epsilon", "ordinary", aimed<epsilon_recipe, without_epsilon>},
    {"not_a_unit", "ordinary", aimed<epsilon_recipe, not_a_unit>},
    {"a_bit_off", "ordinary", aimed<epsilon_recipe, a_bit_off>},
    {"own_not_skipped", "ordinary", own_not_skipped},
    {"sides_alike", "ordinary", sides_alike},
    {"skips_in_secret", "in_millimetres", skips_in_secret},
    {"other_epsilon", "ordinary", other_epsilon},
};

class TracedFault : public Traced, public testing::WithParamInterface<Fault> {};

TEST_P(TracedFault, is_unexplained) {
    const TracedScene& scene = traced_bundled(GetParam().scene);
    const Frame frame = trace_shadow_rays(scene.scene, GetParam().recipe(scene.scene, scene.plan));
    const Comparison comparison = compared(scene, frame);
    EXPECT_GT(comparison.evidence.unexplained, 0U);
    const Technique& technique = *find_technique("traced_epsilon");
    EXPECT_EQ(judge(scene.scene, technique.fails_at, technique.by_nature, comparison),
              Verdict::unexplained);
}

INSTANTIATE_TEST_SUITE_P(Injected, TracedFault, testing::ValuesIn(faults),
                         [](const auto& fault) { return std::string(fault.param.name); });

/// What was read back, changed at single pixels.
class TracedPixelFault : public Traced {
protected:
    const TracedScene& scene = traced_bundled("ordinary");
    Frame frame = render_right();

    Frame render_right() const {
        return trace_shadow_rays(scene.scene, epsilon_recipe(scene.scene, scene.plan));
    }
    /// A pixel of which this holds.
    template <class Holds>
    std::pair<int, int> where(const Holds& holds) const {
        for (int y = 0; y < frame.claim.height; ++y)
            for (int x = 0; x < frame.claim.width; ++x)
                if (holds(frame.rays->pixels.at(x, y))) return {x, y};
        ADD_FAILURE() << "no such pixel";
        return {0, 0};
    }
    void expect_caught(int x, int y) const {
        const Comparison comparison = compared(scene, frame);
        EXPECT_EQ(comparison.evidence.unexplained, 1U);
        EXPECT_EQ(comparison.evidence_miss.at(x, y), 1);
    }
};

TEST_F(TracedPixelFault, a_shadow_that_nothing_casts_is_caught) {
    const auto [x, y] = where([](const TracedPixel& p) { return p.shot && p.occluder == p.none; });
    frame.claim.at(x, y) = Visibility::shadowed;
    expect_caught(x, y);
}

TEST_F(TracedPixelFault, a_shadow_by_a_triangle_elsewhere_is_caught) {
    const auto [x, y] = where([](const TracedPixel& p) { return p.shot && p.occluder == p.none; });
    frame.claim.at(x, y) = Visibility::shadowed;
    frame.rays->pixels.at(x, y).occluder = 0;
    expect_caught(x, y);
}

TEST_F(TracedPixelFault, a_shadow_ray_that_went_through_an_occluder_is_caught) {
    const auto [x, y] = where([](const TracedPixel& p) { return p.shot && p.occluder != p.none; });
    frame.claim.at(x, y) = Visibility::lit;
    frame.rays->pixels.at(x, y).occluder = TracedPixel::none;
    expect_caught(x, y);
}

TEST_F(TracedPixelFault, an_eye_ray_that_went_through_a_surface_is_caught) {
    const auto [x, y] = where([](const TracedPixel& p) { return p.seen != p.none; });
    frame.claim.at(x, y) = Visibility::background;
    frame.rays->pixels.at(x, y) = {.line = frame.rays->pixels.at(x, y).line};
    expect_caught(x, y);
}

TEST_F(TracedPixelFault, a_depth_beyond_its_error_bound_is_caught) {
    const auto [x, y] = where([](const TracedPixel& p) { return p.seen != p.none && !p.shot; });
    frame.rays->pixels.at(x, y).depth *= 1 + 1e-3F;
    expect_caught(x, y);
}

TEST_F(TracedPixelFault, an_eye_that_is_not_the_cameras_leaves_nothing_explained) {
    frame.rays->eye.x += 1e-3F;
    EXPECT_EQ(compared(scene, frame).evidence.unexplained, frame.claim.pixels.size());
}

} // namespace
} // namespace shadowproof
