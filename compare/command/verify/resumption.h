// Whether what an earlier run has done holds for one that goes on with it.
#pragma once

#include "compare/command/verify/worker.h"

#include <span>
#include <string>

namespace shadowproof {

/// Throws Error naming both drivers where the run was begun with another one.
void require_same_driver(const WorkerSetup& setup, const DriverInfo& driver);

/// Reads the scene again, as a step. Throws Error naming it where it is not what the results are
/// of.
void require_same_scene(const WorkerSetup& setup, const std::string& argument,
                        std::span<const SceneResult> results);

/// Takes over a cell that an earlier process has written. Throws Error where files of it are
/// missing.
void recall(const WorkerSetup& setup, const SceneResult& scene, const Cell& cell);

/// Throws the Error of require_same_scene.
[[noreturn]] void refuse_changed(const std::string& argument);

} // namespace shadowproof
