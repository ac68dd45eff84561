// A set of texels: what was put in is listed once, at the place that is told.
#include "compare/maps/texel_set.h"
#include "reference/parallel.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <set>

namespace shadowproof {
namespace {

MapModel cube(int size) {
    MapModel model;
    model.shape = MapModel::Shape::cube;
    model.size = size;
    return model;
}

TEST(TexelSet, lists_what_was_added_once_at_the_place_it_tells) {
    constexpr int size = 21; // its last blocks reach beyond the map
    TexelSet set(cube(size));
    Dice dice(5);
    std::set<Texel> added;
    for (int i = 0; i < 1500; ++i) {
        const Texel texel{static_cast<std::uint32_t>(dice.below(6)),
                          static_cast<int>(dice.below(size)), static_cast<int>(dice.below(size))};
        set.add(texel);
        added.insert(texel);
    }
    const std::vector<Texel> list = set.list(2);
    EXPECT_EQ(std::set<Texel>(list.begin(), list.end()), added);
    EXPECT_EQ(list.size(), added.size());
    for (std::uint32_t face = 0; face < 6; ++face)
        for (int x = 0; x < size; ++x)
            for (int y = 0; y < size; ++y) {
                const Texel texel{face, x, y};
                const std::optional<std::size_t> place = set.place(texel);
                ASSERT_EQ(place.has_value(), added.contains(texel));
                if (place) {
                    EXPECT_EQ(list.at(*place), texel);
                }
            }
}

TEST(TexelSet, sixteen_in_a_row_are_a_block) {
    TexelSet set(cube(16));
    for (int x = 0; x < 16; ++x)
        for (int y = 0; y < 16; ++y) set.add({2, x, y});
    const std::vector<Texel> list = set.list(2);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Texel& first = list[i / 16 * 16];
        EXPECT_EQ(list[i].x / 4, first.x / 4);
        EXPECT_EQ(list[i].y / 4, first.y / 4);
    }
}

TEST(TexelSet, loses_nothing_that_threads_add_at_once) {
    constexpr int size = 64;
    TexelSet set(cube(size));
    parallel_for(6 * size * size, 8, [&](int i, int) {
        const auto face = static_cast<std::uint32_t>(i % 6);
        set.add({face, i / 6 % size, i / 6 / size});
    });
    EXPECT_EQ(set.list(2).size(), 6U * size * size);
}

} // namespace
} // namespace shadowproof
