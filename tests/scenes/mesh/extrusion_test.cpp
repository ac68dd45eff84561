#include "scenes/error.h"
#include "scenes/mesh/extrusion.h"

#include <gtest/gtest.h>

#include <string>

namespace shadowproof {
namespace {

Scene scene_of(double unit) {
    Scene scene;
    scene.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    scene.unit = unit;
    return scene;
}

TEST(extrusion, is_half_the_diagonal_or_what_was_asked_for_in_the_file_s_units) {
    const Scene halves = scene_of(0.5);
    EXPECT_EQ(finite_extrusion(halves, {}), 2.5);
    EXPECT_EQ(finite_extrusion(halves, {.extrusion = 3.0}), 6);
    EXPECT_EQ(finite_extrusion(halves, {.extrusion = 0.0}), 0);
}

TEST(extrusion, is_refused_where_coordinates_do_not_reach) {
    EXPECT_EQ(finite_extrusion(scene_of(1), {.extrusion = 0x1p61}), 0x1p61);
    for (const double length : {0x1p62, 1e39, 1e308}) try {
            finite_extrusion(scene_of(1), {.extrusion = length});
            ADD_FAILURE() << length;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find("--extrusion: "), 0U) << error.what();
        }
}

} // namespace
} // namespace shadowproof
