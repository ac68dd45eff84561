// Cuts a run into parts of about the same cost, one for each of several machines.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// The part of a run: --shard 2/4.
struct Shard {
    std::size_t number = 1; ///< from 1 on
    std::size_t of = 1;
};

/// "2/4"; none if it is anything else, or of more than a million.
std::optional<Shard> parse_shard(const std::string& text);

/// Work that is not divided.
struct ShardUnit {
    std::size_t group = 0;  ///< those of one group stand together, and share the group's own cost
    std::uint64_t cost = 0; ///< of any unit of measure
};

/// Where each of `parts` shards begins among the units, in their order, and where the last one
/// ends. A group's own cost is paid by each shard that has a unit of it. The dearest shard is as
/// cheap as a division in that order allows; no shard is empty if there are enough units. The same
/// for the same input.
std::vector<std::size_t> shard_bounds(std::span<const ShardUnit> units,
                                      std::span<const std::uint64_t> group_costs,
                                      std::size_t parts);

} // namespace shadowproof
