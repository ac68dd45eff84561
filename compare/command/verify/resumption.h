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

/// Throws that Error.
[[noreturn]] void refuse_changed(const std::string& argument);

} // namespace shadowproof
