// Closes open casters before volumes are made of them.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// The scene with triangles appended, as one more mesh, that close all its meshes together: a body
/// made of several meshes may be closed already. The new triangles only cast and are never drawn.
/// Returns the same scene where nothing is open.
Scene with_holes_filled(const Scene& scene);

} // namespace shadowproof
