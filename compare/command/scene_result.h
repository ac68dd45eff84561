// What a report tells of a scene, before any claim is judged.
#pragma once

#include "compare/cell.h"

#include <span>
#include <string>

namespace shadowproof {

/// Fills in what the scene itself tells: its light, size, camera, meshes, notes and digest, not its
/// name nor its truth.
void describe(SceneResult& result, const Scene& scene);

/// A scene's name in the report, after others. Two files may have one stem: the second is "stem-2",
/// in the results and in the report.
std::string unique_name(std::span<const SceneResult> before, const std::string& wanted);

} // namespace shadowproof
