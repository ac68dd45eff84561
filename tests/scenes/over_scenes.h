// Suites that go through the bundled scenes at full size: those that tell most, which .ci/run
// takes, and the rest, whose tests have the label `long`.
#pragma once

#include "tests/scenes/bundled_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof::tests {

/// Between them they have every cause, kind of light, kind of caster and kind of bumps. What the
/// others show, the tests that are named after it look for, or a verify of all of them at another
/// size.
inline constexpr std::array telling_scenes{
    "ordinary",       "near_plane",    "eye_inside",       "far_plane",
    "near_cap_some",  "open_lid",      "light_inside",     "light_on_edge",
    "light_in_plane", "non_manifold",  "t_junctions",      "sun",
    "spot",           "cube_edge",     "many_lights-rim",  "perforated",
    "bumpy_torus",    "skewed_relief", "height_field",     "terminator_highlight",
    "light_range",    "thin_caster",   "bumpy_eye_inside", "in_millimetres"};

/// The names that tell most; or all others.
inline std::vector<std::string> chosen(std::vector<std::string> names, bool telling) {
    std::erase_if(names, [&](const std::string& name) {
        const bool tells =
            std::ranges::find(telling_scenes, std::string_view(name)) != telling_scenes.end();
        return tells != telling;
    });
    return names;
}

/// A scene's name as a test's.
inline std::string name_of_test(const testing::TestParamInfo<std::string>& scene) {
    std::string name = scene.param;
    std::ranges::replace(name, '-', '_');
    return name;
}

} // namespace shadowproof::tests

/// Instantiates a suite over scenes, whose names are its parameters.
#define SHADOWPROOF_OVER_SCENES(Suite, names)                                                      \
    INSTANTIATE_TEST_SUITE_P(Telling, Suite,                                                       \
                             testing::ValuesIn(shadowproof::tests::chosen(names, true)),           \
                             shadowproof::tests::name_of_test);                                    \
    INSTANTIATE_TEST_SUITE_P(Long, Suite,                                                          \
                             testing::ValuesIn(shadowproof::tests::chosen(names, false)),          \
                             shadowproof::tests::name_of_test)
