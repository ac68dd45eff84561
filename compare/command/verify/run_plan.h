// What a run tries, cell by cell, before it begins: for a part of it, --shard.
#pragma once

#include "compare/command/pieces/archive.h"
#include "compare/command/verify/costs.h"
#include "compare/command/verify/shard.h"

#include <string>
#include <vector>

namespace shadowproof {

/// A scene under one of its lights.
struct PlannedLight {
    std::string name{};    ///< in the results of the whole run
    std::string content{}; ///< content_of the scene
    std::uint64_t triangles = 0;
    std::vector<std::string> techniques{};
    bool tried = true; ///< with these techniques; without any where the scene cannot be read
};
SHADOWPROOF_SEND_ALL(PlannedLight, name, content, triangles, techniques, tried)

struct PlannedScene {
    std::string argument{};
    std::vector<PlannedLight> lights{}; ///< one without techniques where it cannot be read
    bool is_whole = true;               ///< this shard tries all of it
};
SHADOWPROOF_SEND_ALL(PlannedScene, argument, lights, is_whole)

/// The shard's part of the whole, of which nothing is left out and nothing done twice: scenes of
/// which it tries nothing are left out; lights of which it tries nothing stay, and say so.
std::vector<PlannedScene> part_of(const std::vector<PlannedScene>& whole, const Shard& shard,
                                  const Costs& costs);

/// The same for plans that are cut into the same parts: of the same scenes, techniques and costs.
std::string plan_name(const std::vector<PlannedScene>& whole, const Costs& costs);

} // namespace shadowproof
