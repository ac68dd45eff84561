#include "compare/command/verify/run_plan.h"

#include "compare/output/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace shadowproof {

namespace {

/// A technique of a light; the light alone where it has none.
struct Place {
    std::size_t scene = 0;
    std::size_t light = 0;
    std::size_t technique = 0;
};

struct Division {
    std::vector<Place> places{};
    std::vector<ShardUnit> units{};
    std::vector<std::uint64_t> group_costs{};
};

Division division_of(const std::vector<PlannedScene>& whole, const Costs& costs) {
    Division division;
    for (std::size_t s = 0; s < whole.size(); ++s)
        for (std::size_t l = 0; l < whole[s].lights.size(); ++l) {
            const PlannedLight& light = whole[s].lights[l];
            if (!light.tried) continue;
            const std::size_t group = division.group_costs.size();
            division.group_costs.push_back(costs.of_scene(light.name, light.triangles));
            for (std::size_t t = 0; t < std::max<std::size_t>(light.techniques.size(), 1); ++t) {
                division.places.push_back({s, l, t});
                division.units.push_back(
                    {group, light.techniques.empty()
                                ? 0
                                : costs.of_cell(light.name, light.techniques[t], light.triangles)});
            }
        }
    return division;
}

} // namespace

std::vector<PlannedScene> part_of(const std::vector<PlannedScene>& whole, const Shard& shard,
                                  const Costs& costs) {
    const Division division = division_of(whole, costs);
    const std::vector<std::size_t> bounds =
        shard_bounds(division.units, division.group_costs, shard.of);
    const std::size_t begin = bounds[shard.number - 1];
    const std::size_t end = bounds[shard.number];
    std::vector<PlannedScene> part = whole;
    for (PlannedScene& scene : part)
        for (PlannedLight& light : scene.lights) {
            light.techniques.clear();
            light.tried = false;
        }
    std::vector<std::size_t> units_here(whole.size(), 0);
    std::vector<std::size_t> units_in_all(whole.size(), 0);
    for (std::size_t i = 0; i < division.places.size(); ++i) {
        const auto& [s, l, t] = division.places[i];
        ++units_in_all[s];
        if (i < begin || i >= end) continue;
        ++units_here[s];
        part[s].lights[l].tried = true;
        const std::vector<std::string>& techniques = whole[s].lights[l].techniques;
        if (!techniques.empty()) part[s].lights[l].techniques.push_back(techniques[t]);
    }
    for (std::size_t s = 0; s < part.size(); ++s)
        part[s].is_whole = units_here[s] == units_in_all[s];
    std::erase_if(part, [](const PlannedScene& scene) {
        return std::none_of(scene.lights.begin(), scene.lights.end(),
                            [](const PlannedLight& light) { return light.tried; });
    });
    return part;
}

std::string plan_name(const std::vector<PlannedScene>& whole, const Costs& costs) {
    std::string text;
    const auto add = [&](const std::string& word) { text += word + '\0'; };
    for (const PlannedScene& scene : whole) {
        add(scene.argument);
        for (const PlannedLight& light : scene.lights) {
            add(light.name);
            add(light.content);
            add(fmt::format("{}", costs.of_scene(light.name, light.triangles)));
            for (const std::string& technique : light.techniques) {
                add(technique);
                add(fmt::format("{}", costs.of_cell(light.name, technique, light.triangles)));
            }
        }
    }
    return fingerprint_of(std::string_view(text)).xxh3.substr(0, 16);
}

} // namespace shadowproof
