// Pictures that are read as they are: spots' soft cones at any size, thin meshes in antialiased
// pictures, and textures.
#include "tests/compare/picture/made_picture.h"
#include "tests/compare/traced_scene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace shadowproof {
namespace {

using tests::Given;
using tests::Point;
using tests::points_of;
using tests::Read;
using tests::read;
using tests::Style;

const Style& style_of(const std::string& name) {
    return *std::ranges::find_if(tests::styles(),
                                 [&](const Style& style) { return style.name == name; });
}

TEST(SpotPicture, of_any_size_has_no_wrong_pixel_however_its_cone_falls_off) {
    const Style linear{"spot_linear", [](const Point& p) { return 0.5 * p.sine * p.into_cone; },
                       0.1};
    for (const int side : {320, 384}) {
        const tests::TracedScene scene(tests::square_scene("spot", side));
        const Image<Point> points = points_of(scene.traced);
        for (const Style& style : {linear, style_of("spot_smooth"), style_of("spot_squared")})
            for (const Given given : tests::all_given) {
                const Read found = read(scene.traced, style, points, scene.truth.visibility, given);
                EXPECT_EQ(found.wrong, 0U) << style.name << tests::words_of(given) << ", " << side;
                EXPECT_GT(found.decided, 0U) << style.name << tests::words_of(given);
            }
    }
}

/// Each pixel the mean of four.
Picture halved(const Picture& picture) {
    Picture half{picture.width / 2, picture.height / 2, 1, 8, {}};
    const auto at = [&](int x, int y) {
        return picture
            .values[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                    static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x) {
            const float sum = at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) +
                              at(2 * x + 1, 2 * y + 1);
            half.values.push_back(std::round(255 * sum / 4) / 255);
        }
    return half;
}

// Of a mesh two pixels wide each pixel may be mixed with what is beside it, and brighter.
TEST(AntialiasedPicture, alone_has_no_dark_pixel_on_thin_meshes) {
    Style style = style_of("diffuse");
    style.paint = 0.2;
    for (const char* const name : {"cube_edge", "slivers", "ordinary", "thin_caster", "nested"})
        for (const int side : {192, 384}) {
            const tests::TracedScene scene(tests::square_scene(name, side));
            const tests::TracedScene fine(tests::square_scene(name, 2 * side));
            const Image<Point> points = points_of(fine.traced);
            for (style.painted = 0; style.painted < 3; ++style.painted) {
                const Picture picture = halved(rendered(style, fine.truth.visibility, points));
                const Frame frame =
                    read_shadows(scene.traced, {"mine.png", "", "", ""}, picture, {});
                EXPECT_TRUE(frame.pictured->antialiased);
                const Comparison found = tests::compared(scene, frame);
                EXPECT_EQ(found.causes[static_cast<std::size_t>(Cause::unexplained)], 0U)
                    << name << ", " << side << ", " << style.painted;
            }
        }
}

// Of a texture, shadows scatter as far as its colours are apart: that excuses nothing.
TEST(TexturedPicture, alone_is_not_told_where_shadows_show_the_texture) {
    Scene scene = tests::square_scene("ordinary", 256);
    const auto floor = static_cast<std::uint32_t>(
        std::ranges::find(scene.meshes, "floor", &Mesh::name) - scene.meshes.begin());
    ASSERT_LT(floor, scene.meshes.size());
    scene.meshes[floor].textured = true;
    const tests::TracedScene traced(scene);
    Image<Point> points = points_of(traced.traced);
    const Style& style = style_of("textured");
    // Tiles that fade into each other.
    const auto tiled = [](int x, int y, double middle) {
        return std::clamp(middle + 2 * std::sin(x / 6.0) * std::sin(y / 6.0), 0.35, 1.0);
    };
    for (const double middle : {0.6, 0.7, 0.8}) {
        for (int y = 0; y < points.height; ++y)
            for (int x = 0; x < points.width; ++x)
                points.at(x, y).albedo = points.at(x, y).mesh != floor ? 1 : tiled(x, y, middle);
        const Read alone =
            read(traced.traced, style, points, traced.truth.visibility, Given::alone);
        EXPECT_EQ(alone.wrong, 0U) << middle;
    }
    const Read twinned = read(traced.traced, style, points, traced.truth.visibility, Given::both);
    EXPECT_EQ(twinned.wrong, 0U);
    EXPECT_GT(twinned.decided, 20000U);
}

} // namespace
} // namespace shadowproof
