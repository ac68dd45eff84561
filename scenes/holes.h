// Open casters closed before volumes are made of them.
#pragma once

#include "scenes/scene.h"

namespace shadowproof {

/// The scene with triangles appended, as one more mesh, that close all its meshes together: a body
/// in several meshes is closed already. They only cast: nobody draws them. The same scene where
/// nothing is open.
Scene with_holes_filled(const Scene& scene);

} // namespace shadowproof
