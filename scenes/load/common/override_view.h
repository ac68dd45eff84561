// A view given beside the file, in place of the file's own.
#pragma once

#include "scenes/load/common/scene_request.h"
#include "scenes/scene.h"

namespace shadowproof {

/// Replaces what the file says by what is given, and says so in the scene's notes. The scene is in
/// the file's units. Throws Error where the matrix cannot place a camera (transposed, mirrored,
/// sheared, not finite) or the light has no position.
void override_view(const ViewOverride& view, Scene& scene);

} // namespace shadowproof
