// One number for what is judged: two scenes with the same digest show the same truth.
#pragma once

#include "scenes/scene.h"

#include <string>

namespace shadowproof {

/// 16 hexadecimal digits over triangles, their sides, camera, picture size and light; and, where it
/// is lit by bump maps, over all that lighting reads. Names and the order of equal positions do not
/// matter to a picture, but count: the same file gives the same.
std::string digest_of(const Scene& scene);

} // namespace shadowproof
