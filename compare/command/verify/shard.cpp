#include "compare/command/verify/shard.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace shadowproof {

namespace {

constexpr std::size_t most_shards = 1'000'000;

std::optional<std::size_t> parse_count(std::string_view text) {
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(text.begin(), text.end(), count);
    if (error != std::errc() || end != text.end() || count < 1 || count > most_shards ||
        text.front() == '0')
        return std::nullopt;
    return count;
}

/// Fills shards one after the other up to a cost. `least_left`: as many units are left for the
/// shards behind as there are of these, if there are so many.
std::vector<std::size_t> filled(std::span<const ShardUnit> units,
                                std::span<const std::uint64_t> group_costs, std::size_t parts,
                                std::uint64_t most, bool least_left) {
    std::vector<std::size_t> bounds{0};
    std::uint64_t load = 0;
    for (std::size_t i = 0; i < units.size(); ++i) {
        const std::size_t begin = bounds.back();
        const bool enters = i == begin || units[i].group != units[i - 1].group;
        const std::uint64_t more = units[i].cost + (enters ? group_costs[units[i].group] : 0);
        const bool reserved = least_left && units.size() - i <= parts - bounds.size();
        if (i == begin || (load + more <= most && !reserved)) {
            load += more;
            continue;
        }
        bounds.push_back(i);
        load = units[i].cost + group_costs[units[i].group];
    }
    bounds.push_back(units.size());
    return bounds;
}

} // namespace

std::optional<Shard> parse_shard(const std::string& text) {
    const std::string_view whole(text);
    const std::size_t slash = whole.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    const auto number = parse_count(whole.substr(0, slash));
    const auto of = parse_count(whole.substr(slash + 1));
    if (!number || !of || *number > *of) return std::nullopt;
    return Shard{*number, *of};
}

std::vector<std::size_t> shard_bounds(std::span<const ShardUnit> units,
                                      std::span<const std::uint64_t> group_costs,
                                      std::size_t parts) {
    // The least cost with which that many shards suffice, by bisection.
    std::uint64_t least = 0;
    std::uint64_t enough = 0;
    for (const ShardUnit& unit : units) {
        const std::uint64_t alone = unit.cost + group_costs[unit.group];
        least = std::max(least, alone);
        enough += alone;
    }
    while (least < enough) {
        const std::uint64_t middle = least + (enough - least) / 2;
        if (filled(units, group_costs, parts, middle, false).size() - 1 <= parts)
            enough = middle;
        else
            least = middle + 1;
    }
    std::vector<std::size_t> bounds = filled(units, group_costs, parts, enough, true);
    bounds.resize(parts + 1, units.size()); // shards without a unit
    return bounds;
}

} // namespace shadowproof
