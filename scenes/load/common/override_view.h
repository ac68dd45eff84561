// A view given beside the file, in place of the file's own.
#pragma once

#include "scenes/load/common/scene_request.h"
#include "scenes/scene.h"

namespace shadowproof {

/// Puts what is given in place of what the file says, and notes it. The scene is in the file's
/// units. Throws Error where the matrix places no camera (transposed, mirrored, sheared, not
/// finite) or the light has no position.
void override_view(const ViewOverride& view, Scene& scene);

} // namespace shadowproof
