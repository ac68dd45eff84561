// A hash of all that is judged: two scenes with the same digest have the same truth.
#pragma once

#include "scenes/scene.h"

#include <string>

namespace shadowproof {

/// 16 hexadecimal digits over triangles, their sides, camera, picture size and light; for a scene
/// lit by bump maps, also over all that lighting reads. Names and the order of equal positions are
/// included, though no picture depends on them: equal files have equal digests.
std::string digest_of(const Scene& scene);

} // namespace shadowproof
