// The numbers of shadow volumes at the ends of the lines of sight, as start values of a counter.
// Every triangle that faces the chosen light is tested; exact, with ties broken as the truth breaks
// them.
#pragma once

#include "scenes/scene.h"

#include <cstddef>

namespace shadowproof {

/// Around the eye, which may be at infinity. Of a scene of casters.
std::size_t volumes_around_eye(const Scene& scene);

/// At infinity, where the parallel lines of sight of an orthographic camera end in one point. The
/// volumes of a directional light never hold it.
std::size_t volumes_at_infinity(const Scene& scene);

} // namespace shadowproof
