// What a report tells of a scene, before any claim is judged.
#pragma once

#include "compare/cell.h"

namespace shadowproof {

/// Fills in what the scene itself tells: its light, size, camera, meshes, notes and digest, not its
/// name nor its truth.
void describe(SceneResult& result, const Scene& scene);

} // namespace shadowproof
