// The number of shadow volumes around the eye, as the start value of a counter.
#pragma once

#include "scenes/scene.h"

#include <cstddef>

namespace shadowproof {

/// Of a scene of casters. Tests every triangle that faces the chosen light; exact, with ties broken
/// as the truth breaks them.
std::size_t volumes_around_eye(const Scene& scene);

} // namespace shadowproof
