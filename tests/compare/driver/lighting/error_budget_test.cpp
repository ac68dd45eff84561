// The error budget of colours: wide enough for what it is stated for, and no wider than that.
#include "compare/driver/lighting/error_budget.h"
#include "compare/driver/lighting/lighting_arithmetic.h"
#include "compare/driver/lighting/lighting_tables.h"
#include "reference/trace/trace.h"
#include "scenes/load/catalog.h"
#include "tests/compare/driver/lighting/one_light.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <string>

namespace shadowproof {
namespace {

glm::dvec3 random_unit(Dice& dice) {
    for (;;) {
        const glm::dvec3 vector(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
        const double length = glm::length(vector);
        if (length > 0.1 && length <= 1) return vector / length;
    }
}

double off_by(const NormalisationCube& cube, const glm::dvec3& unit) {
    return glm::distance(looked_up(cube, unit), unit);
}

/// A cube whose components keep fewer bits of a byte.
NormalisationCube with_bits(NormalisationCube cube, int bits) {
    const double steps = std::exp2(bits) - 1;
    for (Image<glm::u8vec3>& face : cube.faces)
        for (glm::u8vec3& texel : face.pixels)
            for (int k = 0; k < 3; ++k)
                texel[k] = static_cast<std::uint8_t>(
                    std::lround(std::round(texel[k] / 255.0 * steps) / steps * 255));
    return cube;
}

TEST(ErrorBudget, of_a_cube_map_holds_everywhere_and_is_nearly_reached) {
    constexpr std::uint64_t seed = 20261123;
    SCOPED_TRACE(seed);
    Dice dice(seed);
    for (const int size : {8, 32, 64}) {
        const NormalisationCube cube = expected_normalisation_cube(size);
        double closest = 0;
        for (int i = 0; i < 200000; ++i) {
            const glm::dvec3 unit = random_unit(dice);
            const double budget = cube_budget(size, around(unit));
            ASSERT_LE(off_by(cube, unit), budget) << unit.x << " " << unit.y << " " << unit.z;
            closest = std::max(closest, off_by(cube, unit) / budget);
        }
        EXPECT_GT(closest, 0.7) << size;
    }
}

TEST(ErrorBudget, of_a_cube_map_of_64_texels_and_8_bits_is_left_by_32_texels_and_by_7_bits) {
    Dice dice(7);
    const NormalisationCube coarse = expected_normalisation_cube(32);
    const NormalisationCube few_bits = with_bits(expected_normalisation_cube(64), 7);
    int coarse_out = 0;
    int few_bits_out = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 unit = random_unit(dice);
        const double budget = cube_budget(64, around(unit));
        coarse_out += off_by(coarse, unit) > budget ? 1 : 0;
        few_bits_out += off_by(few_bits, unit) > budget ? 1 : 0;
    }
    EXPECT_GT(coarse_out, 100);
    EXPECT_GT(few_bits_out, 1000);
}

TEST(TexelRanges, hold_all_that_is_between_and_no_more) {
    constexpr std::uint64_t seed = 11;
    SCOPED_TRACE(seed);
    Dice dice(seed);
    Image<glm::dvec2> texels(5, 4);
    for (glm::dvec2& texel : texels.pixels) texel = {dice.between(-1, 1), dice.between(-1, 1)};
    const RangeOf<glm::dvec2> whole{Interval{-1, 1}, Interval{-1, 1}};
    for (int i = 0; i < 2000; ++i) {
        const Wrap wrap_s = static_cast<Wrap>(dice.below(3));
        const Wrap wrap_t = static_cast<Wrap>(dice.below(3));
        const auto any_range = [&] {
            const double low = dice.between(-2, 2);
            return Interval{low, low + std::pow(dice.between(0, 1), 3)};
        };
        const PlaceRange at{any_range(), any_range()};
        const auto range = mixed_range(
            turning_places(wrap_s, 5, at[0]), turning_places(wrap_t, 4, at[1]),
            [&](int x, int y) { return texels.at(x, y); }, whole);
        glm::dvec2 low(2);
        glm::dvec2 high(-2);
        constexpr int places = 40;
        for (int a = 0; a <= places; ++a)
            for (int b = 0; b <= places; ++b) {
                const auto value = sample<glm::dvec2>(
                    texels, taps_at(wrap_s, 5, at[0].low + a * width(at[0]) / places),
                    taps_at(wrap_t, 4, at[1].low + b * width(at[1]) / places));
                low = glm::min(low, value);
                high = glm::max(high, value);
            }
        for (int k = 0; k < 2; ++k) {
            const Interval& found = range[static_cast<std::size_t>(k)];
            ASSERT_LE(found.low, low[k] + 1e-12);
            ASSERT_GE(found.high, high[k] - 1e-12);
            // Places are a 40th of up to 5 texels apart, and neighbours differ by up to 2 along
            // either axis.
            ASSERT_GE(found.low, low[k] - 0.5);
            ASSERT_LE(found.high, high[k] + 0.5);
        }
    }
}

TEST(TexelRanges, of_a_cube_map_hold_every_vector_of_a_box_across_its_edges) {
    Dice dice(13);
    const NormalisationCube cube = expected_normalisation_cube(16);
    constexpr Interval any{0, 255};
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 middle = random_unit(dice);
        const double size = 0.3 * std::pow(dice.between(0, 1), 4);
        const Intervals box = around(middle, size);
        const Intervals range = cube_range(cube.faces, box, {any, any, any});
        for (int k = 0; k < 200; ++k) {
            const glm::dvec3 vector =
                middle +
                size * glm::dvec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
            const auto value = sample<glm::dvec3>(cube.faces, vector);
            for (int c = 0; c < 3; ++c)
                ASSERT_TRUE(widened(range[static_cast<std::size_t>(c)], 1e-9).contains(value[c]));
        }
    }
}

/// All that judging one pixel of a bundled scene needs.
struct Pixel {
    Scene scene;
    Tracer tracer;
    GroundTruth truth;

    explicit Pixel(const char* name) : scene(small(name)), tracer(scene), truth(trace(tracer)) {}

    static Scene small(const char* name) {
        SceneRequest request;
        request.width = 64;
        request.height = 64;
        return load_scene(name, request);
    }
    /// Calls visit(inputs at the centre) of every pixel that shows a surface.
    template <class Visit>
    void visit(const Visit& visit) const {
        const Image<Shading> terms = shade_terms(tracer, truth);
        for (int y = 0; y < terms.height; ++y)
            for (int x = 0; x < terms.width; ++x) {
                const std::uint32_t triangle = truth.triangle.at(x, y);
                if (triangle == no_triangle) continue;
                const Shading& shading = terms.at(x, y);
                visit(input_point(scene, shading, triangle, {.middle = shading.weights}));
            }
    }
};

constexpr ColorModel combiners{.arithmetic = ColorModel::Arithmetic::four_stages,
                               .normalisation = Normalisation::cube_map,
                               .bump_form = BumpForm::normal_map};

TEST(ErrorBudget, knows_nothing_of_what_stands_in_the_tables) {
    const Pixel pixel("height_field");
    const LightingTables tables = make_lighting_tables(pixel.scene, combiners);
    LightingTables wrong = tables;
    for (std::optional<BumpTexels>& bumps : wrong.bumps)
        if (bumps)
            for (glm::vec4& texel : bumps->texels.pixels) texel = glm::vec4(0.25F);
    wrong.cube = with_bits(wrong.cube, 2);
    bool claims_differ = false;
    pixel.visit([&](const InputPoint& point) {
        const Intervals bound = tests::bound_by_one(combiners, budgeted_inputs(tables, point));
        const Intervals same = tests::bound_by_one(combiners, budgeted_inputs(wrong, point));
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_EQ(bound[k].low, same[k].low);
            ASSERT_EQ(bound[k].high, same[k].high);
        }
        claims_differ = claims_differ ||
                        tests::predicted_by_one(combiners, claimed_inputs(tables, point))[0].low !=
                            tests::predicted_by_one(combiners, claimed_inputs(wrong, point))[0].low;
    });
    EXPECT_TRUE(claims_differ);
}

TEST(ErrorBudget, holds_the_truth_under_every_setting) {
    for (const char* name : {"height_field", "bumpy_torus", "fine_relief"}) {
        const Pixel pixel(name);
        for (const auto arithmetic :
             {ColorModel::Arithmetic::floating, ColorModel::Arithmetic::three_passes,
              ColorModel::Arithmetic::two_stages, ColorModel::Arithmetic::four_stages})
            for (const Normalisation normalisation : all_normalisations)
                for (const BumpForm form : {BumpForm::as_given, BumpForm::normal_map,
                                            BumpForm::derivatives, BumpForm::indexed}) {
                    const ColorModel model{.arithmetic = arithmetic,
                                           .normalisation = normalisation,
                                           .bump_form = form};
                    const LightingTables tables = make_lighting_tables(pixel.scene, model);
                    pixel.visit([&](const InputPoint& point) {
                        const Intervals bound =
                            tests::bound_by_one(model, budgeted_inputs(tables, point));
                        const glm::dvec3 truth = showable(model, point.shading.color());
                        for (std::size_t k = 0; k < 3; ++k)
                            ASSERT_TRUE(
                                widened(bound[k], 1e-6).contains(truth[static_cast<int>(k)]))
                                << name << " " << name_of(normalisation) << " " << name_of(form);
                    });
                }
    }
}

TEST(ErrorBudget, holds_the_truth_for_any_cube_and_any_number_of_steps) {
    const Pixel pixel("bumpy_torus");
    const auto hold = [&](const ColorModel& model) {
        const LightingTables tables = make_lighting_tables(pixel.scene, model);
        EXPECT_EQ(tables.cube.size,
                  model.normalisation == Normalisation::cube_map ? model.cube_size : 0);
        pixel.visit([&](const InputPoint& point) {
            const Intervals bound = tests::bound_by_one(model, budgeted_inputs(tables, point));
            const glm::dvec3 truth = showable(model, point.shading.color());
            for (std::size_t k = 0; k < 3; ++k)
                ASSERT_TRUE(widened(bound[k], 1e-6).contains(truth[static_cast<int>(k)]))
                    << model.cube_size << " " << model.newton_steps;
        });
    };
    for (const int size : {2, 8, 256})
        hold({.normalisation = Normalisation::cube_map, .cube_size = size});
    for (int steps = 0; steps <= most_newton_steps; ++steps)
        hold({.normalisation = Normalisation::newton_raphson, .newton_steps = steps});
}

TEST(ErrorBudget, of_newton_and_raphson_is_that_of_lomont_and_of_steps_from_there) {
    // As tests/raster/lighting/normalise_test.cpp holds them against the driver.
    EXPECT_EQ(newton_raphson_error(0).low, -0.034376);
    EXPECT_EQ(newton_raphson_error(0).high, 0.033961);
    EXPECT_NEAR(newton_raphson_error(1).low, -0.0017523, 1e-7);
    EXPECT_NEAR(newton_raphson_error(2).low, -4.603e-6, 1e-9);
    EXPECT_NEAR(newton_raphson_error(3).low, -3.18e-11, 1e-13);
    for (const int steps : {1, 2, 3}) EXPECT_EQ(newton_raphson_error(steps).high, 0);
}

/// The budget of a perturbed normal that is kept in bytes: its own texels mixed and divided by
/// their length are in it, texels of 6 bits are not.
TEST(ErrorBudget, of_bumps_is_half_a_step_of_their_texels) {
    const Pixel pixel("height_field");
    ColorModel model;
    model.bump_form = BumpForm::normal_map;
    const LightingTables tables = make_lighting_tables(pixel.scene, model);
    LightingTables coarse = tables;
    for (std::optional<BumpTexels>& bumps : coarse.bumps)
        if (bumps)
            for (glm::vec4& texel : bumps->texels.pixels) texel = glm::round(63.F * texel) / 63.F;
    int out = 0;
    pixel.visit([&](const InputPoint& point) {
        const Intervals budget = box_around(budgeted_inputs(tables, point).bump);
        const glm::dvec3 kept = middle(claimed_inputs(tables, point).bump.box);
        const glm::dvec3 cut = middle(claimed_inputs(coarse, point).bump.box);
        bool outside = false;
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_TRUE(budget[k].contains(kept[static_cast<int>(k)]));
            outside = outside || !budget[k].contains(cut[static_cast<int>(k)]);
        }
        out += outside ? 1 : 0;
    });
    EXPECT_GT(out, 50);
}

} // namespace
} // namespace shadowproof
