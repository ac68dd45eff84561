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

/// Those of the names that are among `some`; or all others.
template <class Names>
std::vector<std::string> chosen(std::vector<std::string> names, const Names& some, bool among) {
    std::erase_if(names, [&](const std::string& name) {
        return (std::ranges::find(some, std::string_view(name)) != some.end()) != among;
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

/// Instantiates a suite over scenes, whose names are its parameters: `some` of them as Telling, the
/// others as Long.
#define SHADOWPROOF_OVER_SOME_SCENES(Suite, names, some)                                           \
    INSTANTIATE_TEST_SUITE_P(Telling, Suite,                                                       \
                             testing::ValuesIn(shadowproof::tests::chosen(names, some, true)),     \
                             shadowproof::tests::name_of_test);                                    \
    INSTANTIATE_TEST_SUITE_P(Long, Suite,                                                          \
                             testing::ValuesIn(shadowproof::tests::chosen(names, some, false)),    \
                             shadowproof::tests::name_of_test)

#define SHADOWPROOF_OVER_SCENES(Suite, names)                                                      \
    SHADOWPROOF_OVER_SOME_SCENES(Suite, names, shadowproof::tests::telling_scenes)
