// What verify tries of which scene, and by which names; for a shard before it begins.
#pragma once

#include "compare/command/verify/run_plan.h"
#include "compare/command/verify/worker.h"

#include <span>
#include <string>
#include <vector>

namespace shadowproof {

/// How the run reads its scenes: with every light, unless one is chosen.
SceneRequest request_of(const VerifyOptions& options);

/// Reads a scene as a step of its own. Throws as load_scene and Pieces::step do.
Scene read_scene(const WorkerSetup& setup, const std::string& argument);

/// The chosen techniques that are for the scene under its chosen light. Those that are not are left
/// out, unless they and the scene are named: then they say so.
std::vector<const Technique*> techniques_for(const VerifyOptions& options, const Scene& scene);

/// The name of a scene that was not read.
std::string name_of_file(const std::string& argument);
/// The name of a scene's result under its chosen light, unique among those before it.
std::string name_of_result(const Scene& scene, bool one_of_many,
                           std::span<const SceneResult> before);

struct PlannedShard {
    std::vector<PlannedScene> scenes{};
    std::string plan{}; ///< the name of the whole run's
};
SHADOWPROOF_SEND_ALL(PlannedShard, scenes, plan)

/// The part of the run that the shard has, as a piece: every scene is read.
PlannedShard planned_shard(const WorkerSetup& setup);

} // namespace shadowproof
