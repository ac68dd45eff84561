// What a report tells of a scene, before any claim is judged.
#pragma once

#include "compare/cell.h"

#include <optional>
#include <span>
#include <string>

namespace shadowproof {

/// Fills in what the scene itself tells: its light, size, camera, meshes, notes and digest, not its
/// name nor its truth.
void describe(SceneResult& result, const Scene& scene);

/// What to say of a scene whose colours add up several lights; nothing of others.
std::optional<std::string> note_on_added_lights(const Scene& scene);

/// What of a scene under its chosen light decides about its results: the truth's digest, and what
/// the scene declares to provoke. The second is of a scene that was described.
std::string content_of(const Scene& scene);
std::string content_of(const SceneResult& result);

/// A scene's name in the report, after others. Two files may have one stem: the second is "stem-2",
/// in the results and in the report.
std::string unique_name(std::span<const SceneResult> before, const std::string& wanted);

} // namespace shadowproof
