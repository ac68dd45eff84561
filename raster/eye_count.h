// The number of shadow volumes around the eye, for a counter that begins with it.
#pragma once

#include "scenes/scene.h"

#include <cstddef>

namespace shadowproof {

/// Asks every triangle that faces the chosen light. Exact, ties broken as the truth breaks them; of
/// a scene of casters.
std::size_t volumes_around_eye(const Scene& scene);

} // namespace shadowproof
