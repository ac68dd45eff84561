// The settings of the techniques that light bump maps, and those that light them as hardware of
// their day did, in bytes: what must hold of their colours, and where they must fail.
#include "raster/render.h"
#include "reference/shade/shading.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowproof::tests {
namespace {

constexpr const char* techniques[]{
    "bump_tangent_space",     "bump_tangent_space_per_vertex", "bump_eye_space",
    "bump_three_pass",        "bump_three_pass_per_pixel",     "bump_one_pass",
    "bump_one_pass_per_pixel"};

/// A bundled scene in a small picture, with all terms of its truth.
struct Lit {
    Scene scene;
    Plan plan{};
    GroundTruth truth{};
    Image<Shading> terms{};
};

Lit lit(const std::string& name) {
    SceneRequest request;
    request.width = 160;
    request.height = 160;
    Lit lit{load_scene(name, request)};
    lit.plan = make_plan(lit.scene);
    const Tracer tracer(lit.scene);
    lit.truth = trace(tracer);
    lit.terms = shade_terms(tracer, lit.truth);
    return lit;
}

bool has_height_fields_alone(const Scene& scene) {
    return std::ranges::none_of(scene.materials, [](const Material& material) {
        return material.bump == Bump::normal_map;
    });
}

/// Calls visit(claimed colour, truth's terms) of all pixels where surface and visibility agree.
template <class Visit>
void visit_agreeing(const Lit& lit, const Frame& frame, const Visit& visit) {
    for (int y = 0; y < frame.color.height; ++y)
        for (int x = 0; x < frame.color.width; ++x)
            if (frame.triangle.at(x, y) == lit.truth.triangle.at(x, y) &&
                frame.claim.at(x, y) == lit.truth.visibility.at(x, y))
                visit(glm::dvec3(frame.color.at(x, y)), lit.terms.at(x, y));
}

/// As bytes would show that.
double square_of_difference(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 off = glm::clamp(a, 0.0, 1.0) - glm::clamp(b, 0.0, 1.0);
    return glm::dot(off, off) / 3;
}

/// Root mean squares: of the claim's distance from the truth, and of that of truths without their
/// diffuse term, without their highlight, or with a surface without bumps for N . L; the least.
struct Distances {
    double claimed = 0;
    double forgetting = 0;
};
Distances distances_from_truth(const Lit& lit, const Frame& frame) {
    glm::dvec4 sums(0);
    std::size_t count = 0;
    visit_agreeing(lit, frame, [&](const glm::dvec3& claim, const Shading& terms) {
        const glm::dvec3 truth = terms.color();
        const double flat =
            terms.self_shadow_light * std::max(glm::dot(terms.normal, terms.to_light), 0.0);
        const glm::dvec3 smooth =
            terms.lit ? flat * terms.light * terms.decal - terms.diffuse_color : glm::dvec3(0);
        sums += glm::dvec4(square_of_difference(claim, truth),
                           square_of_difference(truth - terms.diffuse_color, truth),
                           square_of_difference(truth - terms.specular_color, truth),
                           square_of_difference(truth + smooth, truth));
        ++count;
    });
    const glm::dvec4 distances = glm::sqrt(sums / static_cast<double>(count));
    return {distances.x, std::min({distances.y, distances.z, distances.w})};
}

class HardwareLighting : public testing::Test {
protected:
    Gpu gpu{GlPlatform::osmesa};

    Frame draw(const Lit& lit, const std::string& technique, const LightingSettings& settings) {
        Plan plan = lit.plan;
        plan.asked.lighting = settings;
        return render(*find_technique(technique), lit.scene, plan, gpu);
    }
};

class EachSetting : public HardwareLighting, public testing::WithParamInterface<std::string> {};

TEST_P(EachSetting, draws_colours_nearer_to_the_truth_than_without_a_term_and_says_how) {
    const Lit scene = lit(GetParam());
    for (const char* technique : techniques)
        for (const Normalisation normalisation : all_normalisations) {
            SCOPED_TRACE(std::string(technique) + ", " + std::string(name_of(normalisation)));
            const Frame frame = draw(scene, technique, {.normalisation = normalisation});
            EXPECT_EQ(frame.color_model.normalisation, normalisation);
            const Distances distances = distances_from_truth(scene, frame);
            RecordProperty(technique + ("_" + std::string(name_of(normalisation))),
                           std::to_string(255 * distances.claimed));
            EXPECT_LT(distances.claimed, distances.forgetting);
        }
}

TEST_P(EachSetting, draws_bumps_of_each_form_nearer_to_the_truth_than_without_a_term_or_refuses) {
    const Lit scene = lit(GetParam());
    for (const char* technique : techniques)
        for (const BumpForm form : all_bump_forms) {
            SCOPED_TRACE(std::string(technique) + ", " + std::string(name_of(form)));
            const LightingSettings settings{.bump_form = form};
            if (form == BumpForm::height_field && !has_height_fields_alone(scene.scene)) {
                EXPECT_THROW(draw(scene, technique, settings), Error);
                continue;
            }
            const Frame frame = draw(scene, technique, settings);
            EXPECT_EQ(frame.color_model.bump_form, form);
            const Distances distances = distances_from_truth(scene, frame);
            RecordProperty(technique + ("_" + std::string(name_of(form))),
                           std::to_string(255 * distances.claimed));
            EXPECT_LT(distances.claimed, distances.forgetting);
        }
}

INSTANTIATE_TEST_SUITE_P(Bundled, EachSetting,
                         testing::Values("bumpy_sphere", "bumpy_torus", "height_field",
                                         "mirrored_skin"),
                         [](const auto& scene) { return scene.param; });

TEST_F(HardwareLighting, has_settings_of_its_own_where_nothing_is_asked_for) {
    const Lit scene = lit("bumpy_sphere");
    for (const char* technique : techniques) {
        const Frame frame = draw(scene, technique, {});
        const bool hardware = std::string_view(technique).find("_pass") != std::string_view::npos;
        EXPECT_EQ(frame.color_model.normalisation,
                  hardware ? Normalisation::cube_map : Normalisation::exact);
        EXPECT_EQ(frame.color_model.bump_form,
                  hardware ? BumpForm::normal_map : BumpForm::as_given);
        EXPECT_EQ(frame.color_model.tangents, TangentSource::vertices);
        using Words = std::string_view;
        EXPECT_EQ(frame.color_model.vectors,
                  technique == Words("bump_three_pass") || technique == Words("bump_one_pass")
                      ? VectorOrigin::at_vertices
                  : technique == Words("bump_tangent_space_per_vertex")
                      ? VectorOrigin::unit_at_vertices
                      : VectorOrigin::per_pixel);
    }
}

TEST_F(HardwareLighting, in_bytes_is_bytes_and_claims_the_visibility_that_zfail_reversed_does) {
    const Lit scene = lit("bumpy_torus");
    const Frame plain = draw(scene, "zfail_reversed", {});
    for (const char* technique : {"bump_three_pass", "bump_three_pass_per_pixel", "bump_one_pass",
                                  "bump_one_pass_per_pixel"}) {
        const Frame frame = draw(scene, technique, {});
        EXPECT_EQ(frame.claim.pixels, plain.claim.pixels);
        EXPECT_EQ(frame.counted->counter.pixels, plain.counted->counter.pixels);
        EXPECT_EQ(frame.depth.pixels, plain.depth.pixels);
        for (const glm::vec3& color : frame.color.pixels)
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(color[c], static_cast<float>(std::round(255.0 * color[c]) / 255));
    }
}

/// With vectors that are exact and slopes that are, m normalised: what is left of the three
/// passes' error are the bytes. Of each of four passes at most a step is lost, and none is made
/// larger by those behind it, where nothing is clamped.
TEST_F(HardwareLighting, in_three_passes_loses_no_more_than_the_bytes) {
    const Lit scene = lit("height_field");
    const Frame frame =
        draw(scene, "bump_three_pass_per_pixel",
             {.normalisation = Normalisation::exact, .bump_form = BumpForm::height_field});
    std::size_t compared = 0;
    visit_agreeing(scene, frame, [&](const glm::dvec3& claim, const Shading& terms) {
        const glm::dvec3 undecaled =
            scene.scene.ambient + terms.light * terms.diffuse * (terms.lit ? 1.0 : 0.0);
        if (std::max({undecaled.r, undecaled.g, undecaled.b}) > 1) return;
        const glm::dvec3 off = glm::abs(claim - glm::clamp(terms.color(), 0.0, 1.0));
        EXPECT_LT(std::max({off.r, off.g, off.b}), 4.0 / 255);
        ++compared;
    });
    EXPECT_GT(compared, frame.color.pixels.size() / 4);
}

/// The one pass multiplies the highlight by selfShadow(L) as well, the three do not: where that is
/// below 1 and there is a highlight, they differ by more than their bytes do elsewhere.
TEST_F(HardwareLighting, in_one_pass_dims_highlights_near_the_terminator) {
    constexpr LightingSettings exact{.normalisation = Normalisation::exact};
    double near_terminator = 0;
    double elsewhere = 0;
    std::size_t near_count = 0;
    std::size_t elsewhere_count = 0;
    for (const char* name : {"bumpy_sphere", "bumpy_torus", "height_field", "mirrored_skin"}) {
        const Lit scene = lit(name);
        const Frame three = draw(scene, "bump_three_pass", exact);
        const Frame one = draw(scene, "bump_one_pass", exact);
        for (std::size_t i = 0; i < scene.terms.pixels.size(); ++i) {
            const Shading& terms = scene.terms.pixels[i];
            if (!terms.lit || three.claim.pixels[i] != Visibility::lit) continue;
            if (std::pow(glm::dot(terms.half, terms.bumped), 8) < 0.25) continue; // no highlight
            const glm::vec3 less = three.color.pixels[i] - one.color.pixels[i];
            const double loss = (less.r + less.g + less.b) / 3;
            if (terms.self_shadow_light < 0.5) {
                near_terminator += loss;
                ++near_count;
            } else if (terms.self_shadow_light == 1) {
                elsewhere += std::abs(loss);
                ++elsewhere_count;
            }
        }
    }
    ASSERT_GT(near_count, 0U);
    ASSERT_GT(elsewhere_count, 0U);
    near_terminator /= static_cast<double>(near_count);
    elsewhere /= static_cast<double>(elsewhere_count);
    EXPECT_GT(near_terminator, 0.25 * 0.5 * 0.5); // half of the faintest, half of it for the colour
    EXPECT_LT(elsewhere, near_terminator / 4);
}

} // namespace
} // namespace shadowproof::tests
