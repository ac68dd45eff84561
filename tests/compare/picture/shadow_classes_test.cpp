// What is read from a picture is what it shows, however its renderer lights surfaces.
#include "tests/compare/picture/made_picture.h"
#include "tests/compare/traced_bundled.h"
#include "tests/scenes/over_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

using tests::all_given;
using tests::Given;
using tests::Point;
using tests::points_of;
using tests::Read;
using tests::read;
using tests::Style;
using tests::styles;
using tests::traced_bundled;
using tests::with_shadows_off;
using tests::words_of;

class PictureOf : public testing::TestWithParam<std::string> {
protected:
    const shadowproof::TracedScene& traced = traced_bundled(GetParam()).traced;
    const Image<Point> points = points_of(traced);

    /// Whether the style differs from others here.
    bool is_of_use(const Style& style) const {
        return !style.of_spots || chosen_light(traced.scene()).kind == Light::Kind::spot;
    }
    /// Where the light lies on a surface, it falls off to nothing at once.
    bool is_blinding(const Style& style) const {
        return style.name == std::string("falling_off") && GetParam() == "light_on_face";
    }
};

class FaultyPictureOf : public PictureOf {};

/// Where light seldom grazes what is seen.
class WellLitPictureOf : public PictureOf {};

TEST_P(PictureOf, a_right_renderer_shows_no_wrong_pixel) {
    for (const Style& style : styles())
        for (const Given given : all_given) {
            if ((style.textured && given == Given::alone) || is_blinding(style) ||
                !is_of_use(style) || (style.needs_twins && given != Given::both) ||
                (style.name == std::string("rough") && given == Given::unshadowed))
                continue;
            const Read found = read(traced, style, points, traced.truth().visibility, given);
            EXPECT_EQ(found.wrong, 0U) << style.name << words_of(given);
            // Alone, it need not show what shadows look like; the light may but graze; and without
            // the light or without shadows, both may be the same.
            if (given == Given::unlit && GetParam() != "grazing_light") {
                EXPECT_GT(found.decided, 0U) << style.name;
            }
        }
}

TEST_P(WellLitPictureOf, leaves_open_less_than_one_pixel_in_a_hundred) {
    const auto facing = static_cast<std::size_t>(
        std::ranges::count_if(points.pixels, [](const Point& point) { return point.sine > 0; }));
    for (const Style& style : styles()) {
        if (!is_of_use(style)) continue;
        // What is smooth turns away, and what falls off fades, where nothing tells.
        if (!(style.light({.sine = 1, .distance = 1e3, .smooth_sine = 0}) > 0.1)) continue;
        for (const Given given : {Given::alone, Given::unlit}) {
            // What the one mesh of a material shows in light alone tells nothing of its shadow; and
            // all materials look alike where light is the same at all angles.
            const bool is_alike = style.paint > 0.9 && style.glow < 0.1 && !style.textured;
            const auto shown = [&](double sine) {
                return std::min(1.0, style.ambient + style.light({.sine = sine}));
            };
            if (given == Given::alone && !(is_alike && shown(0.9) > shown(0.4))) continue;
            const Read found = read(traced, style, points, traced.truth().visibility, given);
            EXPECT_LT(facing - found.decided, points.pixels.size() / 100)
                << style.name << words_of(given);
        }
    }
}

/// How many of the pixels that `classes` has as partly lit are decided.
std::size_t decided_dark(const Read& read, const Image<Visibility>& classes) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < read.flags.size(); ++i)
        if (classes.pixels[i] == Visibility::partly_lit) count += read.flags[i];
    return count;
}

// A square in the middle of the picture is dark, which no truth is, or nearly so: none of its
// pixels is taken for lit. With both twins none is left out that would be decided if it were lit;
// with one two of three are not, though other normals may leave open how bright they should be.
TEST_P(FaultyPictureOf, is_seen_to_be_falsely_dark) {
    constexpr int half = 40;
    Image<Visibility> classes = traced.truth().visibility;
    std::size_t dark = 0;
    for (int y = classes.height / 2 - half; y < classes.height / 2 + half; ++y)
        for (int x = classes.width / 2 - half; x < classes.width / 2 + half; ++x)
            if (classes.at(x, y) == Visibility::lit) {
                classes.at(x, y) = Visibility::partly_lit;
                ++dark;
            }
    const std::string lambert = "diffuse";
    for (const Style& style : styles()) {
        if (is_blinding(style) || !is_of_use(style)) continue;
        for (const Given given : {Given::unlit, Given::both}) {
            if (style.needs_twins && given != Given::both) continue;
            // Where light grazes, all depends on normals, and nobody tells which.
            if (GetParam() == "low_light" && given != Given::both) continue;
            const Read right = read(traced, style, points, traced.truth().visibility, given);
            const std::size_t told = decided_dark(right, classes);
            for (const double leaks : {0.0, 0.05}) {
                if (leaks > 0 && style.name != lambert) continue;
                const Read found = read(traced, style, points, classes, given, leaks);
                EXPECT_LE(found.wrong, leaks > 0 ? dark / 8 : 0)
                    << style.name << ", " << leaks << words_of(given);
                EXPECT_GE(decided_dark(found, classes), given == Given::both ? told : 2 * told / 3)
                    << style.name << ", " << leaks << words_of(given);
            }
        }
    }
}

// Unless the picture alone is refused, as it shows no shadow.
TEST_P(FaultyPictureOf, is_seen_to_lack_shadows) {
    const Image<Visibility> classes = with_shadows_off(traced);
    for (const Style& style : styles()) {
        if (is_blinding(style) || !is_of_use(style)) continue;
        for (const Given given : all_given)
            if ((given != Given::alone || !style.textured) &&
                (given == Given::both || !style.needs_twins)) {
                const Read found = read(traced, style, points, classes, given);
                EXPECT_EQ(found.wrong, 0U) << style.name << words_of(given);
                if (given == Given::unlit || given == Given::both) {
                    EXPECT_GT(found.decided, 0U) << style.name << words_of(given);
                }
            }
    }
}

/// Each kind of light, bumps, holes, and light that falls off, or grazes.
constexpr std::array some_scenes{"ordinary",        "sun",        "spot",      "light_range",
                                 "many_lights-rim", "perforated", "low_light", "height_field"};

SHADOWPROOF_OVER_SOME_SCENES(PictureOf, tests::bundled_names(), some_scenes);
SHADOWPROOF_OVER_SOME_SCENES(WellLitPictureOf,
                             (std::vector<std::string>{"ordinary", "sun", "overlapping",
                                                       "near_plane", "far_plane", "eye_inside",
                                                       "long_shadow", "cube_edge"}),
                             (std::array{"sun", "far_plane"}));
SHADOWPROOF_OVER_SOME_SCENES(FaultyPictureOf,
                             (std::vector<std::string>{"ordinary", "sun", "spot", "nested",
                                                       "low_light", "height_field",
                                                       "many_lights-rim"}),
                             (std::array{"sun", "low_light", "height_field"}));

} // namespace
} // namespace shadowproof
