// A run cut into shards: by brute force over all ways of cutting small ones, and by properties.
#include "compare/command/verify/run_plan.h"
#include "compare/command/verify/shard.h"
#include "tests/dice.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowproof {
namespace {

struct Case {
    std::vector<ShardUnit> units{};
    std::vector<std::uint64_t> group_costs{};
};

/// Groups of units side by side, as scenes have their cells.
Case diced(Dice& dice, std::size_t most_groups, std::size_t most_units) {
    Case made;
    made.group_costs.resize(1 + dice.below(most_groups));
    for (std::size_t g = 0; g < made.group_costs.size(); ++g) {
        made.group_costs[g] = dice.below(20);
        for (std::size_t left = 1 + dice.below(most_units); left > 0; --left)
            made.units.push_back({g, dice.below(dice.one_in(9) ? 900 : 30)});
    }
    return made;
}

std::uint64_t cost_of(const Case& made, std::size_t begin, std::size_t end) {
    std::uint64_t cost = 0;
    for (std::size_t i = begin; i < end; ++i) {
        cost += made.units[i].cost;
        if (i == begin || made.units[i].group != made.units[i - 1].group)
            cost += made.group_costs[made.units[i].group];
    }
    return cost;
}

std::uint64_t dearest(const Case& made, const std::vector<std::size_t>& bounds) {
    std::uint64_t most = 0;
    for (std::size_t i = 1; i < bounds.size(); ++i)
        most = std::max(most, cost_of(made, bounds[i - 1], bounds[i]));
    return most;
}

/// The least that the dearest of so many parts can cost, by trying every first part.
std::uint64_t least_possible(const Case& made, std::size_t begin, std::size_t parts) {
    const std::size_t end = made.units.size();
    if (parts == 1) return cost_of(made, begin, end);
    std::uint64_t best = ~std::uint64_t{0};
    for (std::size_t cut = begin; cut <= end; ++cut)
        best = std::min(best,
                        std::max(cost_of(made, begin, cut), least_possible(made, cut, parts - 1)));
    return best;
}

TEST(Shards, the_dearest_is_as_cheap_as_any_division_in_order_makes_it) {
    Dice dice(1);
    for (int i = 0; i < 3000; ++i) {
        const Case made = diced(dice, 4, 3);
        const std::size_t parts = 1 + dice.below(4);
        const auto bounds = shard_bounds(made.units, made.group_costs, parts);
        EXPECT_EQ(dearest(made, bounds), least_possible(made, 0, parts)) << "case " << i;
    }
}

TEST(Shards, cover_all_units_once_and_none_is_empty_where_there_are_enough) {
    Dice dice(2);
    for (int i = 0; i < 2000; ++i) {
        const Case made = diced(dice, 30, 20);
        const std::size_t parts = 1 + dice.below(60);
        const auto bounds = shard_bounds(made.units, made.group_costs, parts);
        ASSERT_EQ(bounds.size(), parts + 1);
        EXPECT_EQ(bounds.front(), 0U);
        EXPECT_EQ(bounds.back(), made.units.size());
        EXPECT_TRUE(std::ranges::is_sorted(bounds));
        if (made.units.size() < parts) continue;
        EXPECT_EQ(std::ranges::adjacent_find(bounds), bounds.end()) << "case " << i;
    }
}

TEST(Shards, of_no_units_are_all_empty) {
    EXPECT_EQ(shard_bounds({}, {}, 3), (std::vector<std::size_t>{0, 0, 0, 0}));
}

TEST(Shards, are_named_by_number_and_count) {
    const auto parsed = [](const char* text) {
        const auto shard = parse_shard(text);
        return shard ? std::pair(shard->number, shard->of) : std::pair<std::size_t, std::size_t>();
    };
    EXPECT_EQ(parsed("1/1"), (std::pair<std::size_t, std::size_t>(1, 1)));
    EXPECT_EQ(parsed("7/1000000"), (std::pair<std::size_t, std::size_t>(7, 1000000)));
    for (const char* wrong : {"", "/", "1/", "/2", "0/2", "3/2", "1/1000001", " 1/2", "1/2 ",
                              "+1/2", "1/2/3", "0x1/2", "1.0/2", "99999999999999999999/2"})
        EXPECT_FALSE(parse_shard(wrong)) << wrong;
}

TEST(RunPlan, the_parts_of_a_run_have_its_cells_once_and_in_its_order) {
    Dice dice(3);
    for (int i = 0; i < 300; ++i) {
        std::vector<PlannedScene> whole;
        std::vector<std::string> all;
        for (std::size_t s = 1 + dice.below(6); s > 0; --s) {
            PlannedScene& scene = whole.emplace_back(
                PlannedScene{.argument = "scene" + std::to_string(s), .lights = {}});
            for (std::size_t l = 1 + dice.below(3); l > 0; --l) {
                PlannedLight& light = scene.lights.emplace_back(
                    PlannedLight{.name = scene.argument + "-" + std::to_string(l),
                                 .triangles = 1000,
                                 .techniques = {}});
                for (std::size_t t = dice.below(5); t > 0; --t)
                    light.techniques.push_back("t" + std::to_string(t));
                if (light.techniques.empty()) all.push_back(light.name);
                for (const std::string& technique : light.techniques)
                    all.push_back(light.name + " " + technique);
            }
        }
        const std::size_t parts = 1 + dice.below(9);
        std::vector<std::string> seen;
        for (std::size_t number = 1; number <= parts; ++number)
            for (const PlannedScene& scene : part_of(whole, {number, parts}, Costs())) {
                std::size_t tried = 0;
                for (const PlannedLight& light : scene.lights) {
                    if (!light.tried) {
                        EXPECT_TRUE(light.techniques.empty());
                        continue;
                    }
                    if (light.techniques.empty()) seen.push_back(light.name);
                    tried += std::max<std::size_t>(light.techniques.size(), 1);
                    for (const std::string& technique : light.techniques)
                        seen.push_back(light.name + " " + technique);
                }
                const auto same = std::ranges::find(whole, scene.argument, &PlannedScene::argument);
                std::size_t of_all = 0;
                for (const PlannedLight& light : same->lights)
                    of_all += std::max<std::size_t>(light.techniques.size(), 1);
                EXPECT_EQ(scene.is_whole, tried == of_all);
            }
        EXPECT_EQ(seen, all);
    }
}

} // namespace
} // namespace shadowproof
