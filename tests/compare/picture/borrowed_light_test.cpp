// What a mesh that shows light alone may take from another one, and what not.
#include "compare/picture/reading/borrowed_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <vector>

namespace shadowproof {
namespace {

constexpr float step = 1 / 255.0F;

struct Look {
    double ambient = 0.1;
    double diffuse = 0.8;
};

/// Twenty pixels of a plain mesh at each of some sines, all of one class.
std::vector<Observed> pixels_of(const Look& look, Visibility certainly,
                                std::initializer_list<float> sines) {
    std::vector<Observed> pixels;
    for (const float sine : sines)
        for (int i = 0; i < 20; ++i) {
            Observed pixel;
            const double light = certainly == Visibility::lit ? look.diffuse * sine : 0;
            pixel.value = glm::dvec3(look.ambient + light);
            pixel.step = step;
            pixel.lies.fill({.sine = sine, .off_half = 0.9F});
            pixel.faces_light = true;
            pixel.certainly = certainly;
            pixels.push_back(pixel);
        }
    return pixels;
}

std::vector<const Observed*> places(const std::vector<Observed>& pixels) {
    std::vector<const Observed*> all;
    for (const Observed& pixel : pixels) all.push_back(&pixel);
    return all;
}

/// A mesh whose light is known, as linear between the angles.
MeshLight fit_of(const Look& look) {
    MeshLight fit;
    fit.shadow = Typical{glm::dvec3(look.ambient), 0};
    for (const double sine : {0.2, 0.6, 0.95}) {
        const double light = look.diffuse * sine * std::sqrt(3.0); // a distance of colours
        fit.light.push_back({sine, light, 0.9 * light});
    }
    return fit;
}

const std::vector<Observed> known_pixels = pixels_of({}, Visibility::lit, {0.2F, 0.6F, 0.95F});

std::vector<MeshLight> borrowed(const std::vector<Observed>& shown,
                                const std::vector<Observed>& of_known = known_pixels) {
    const std::vector<KnownLight> known{known_light(fit_of({}), places(of_known))};
    return borrowed_light(mesh_samples(places(shown)), known);
}

TEST(borrowed_light, is_that_of_a_mesh_that_shows_the_same_at_two_angles) {
    const std::vector<MeshLight> fits = borrowed(pixels_of({}, Visibility::lit, {0.3F, 0.8F}));
    ASSERT_EQ(fits.size(), all_normals_by.size()); // nobody knows by which this one is shaded
    std::vector<bool> there(all_normals_by.size());
    for (const MeshLight& fit : fits) there[fit.normals] = true;
    EXPECT_EQ(there, std::vector<bool>(all_normals_by.size(), true));
    EXPECT_EQ(fits.front().shadow->color, glm::dvec3(0.1));
}

TEST(borrowed_light, is_none_at_one_angle_or_at_two_of_about_the_same_light) {
    EXPECT_TRUE(borrowed(pixels_of({}, Visibility::lit, {0.5F})).empty());
    EXPECT_TRUE(borrowed(pixels_of({}, Visibility::lit, {0.58F, 0.59F})).empty());
    // Brighter in shadow, and as bright at an angle between.
    EXPECT_TRUE(borrowed(pixels_of({0.38, 0.4}, Visibility::lit, {0.7F, 0.74F})).empty());
}

TEST(borrowed_light, is_none_of_another_material) {
    EXPECT_TRUE(borrowed(pixels_of({0.08, 0.64}, Visibility::lit, {0.3F, 0.8F})).empty());
    EXPECT_TRUE(borrowed(pixels_of({0.2, 0.8}, Visibility::lit, {0.3F, 0.8F})).empty());
    // Lit alike, but its shadow is another.
    std::vector<Observed> shown = pixels_of({}, Visibility::lit, {0.3F, 0.8F});
    const std::vector<Observed> dark = pixels_of({0.3, 0}, Visibility::shadowed, {0.5F});
    shown.insert(shown.end(), dark.begin(), dark.end());
    EXPECT_TRUE(borrowed(shown).empty());
}

TEST(borrowed_light, is_kept_where_what_should_be_in_shadow_shows_light) {
    std::vector<Observed> shown = pixels_of({}, Visibility::lit, {0.3F, 0.8F, 0.5F});
    for (std::size_t i = 40; i < shown.size(); ++i) shown[i].certainly = Visibility::shadowed;
    EXPECT_FALSE(borrowed(shown).empty());
}

// Else a black floor would be as bright as a ball's black shadow.
TEST(borrowed_light, is_none_of_a_mesh_that_shows_no_light_for_certain) {
    EXPECT_TRUE(borrowed(pixels_of({0.1, 0}, Visibility::lit, {0.3F, 0.8F}), {}).empty());
    EXPECT_TRUE(borrowed(pixels_of({0.1, 0}, Visibility::lit, {0.3F, 0.8F}),
                         pixels_of({0.1, 0}, Visibility::lit, {0.2F, 0.9F}))
                    .empty());
}

} // namespace
} // namespace shadowproof
