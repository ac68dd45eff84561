// Techniques that are two: one finds shadows, the other lights bumps where there are none.
#pragma once

#include "raster/technique.h"

namespace shadowproof {

/// Lights as one technique where the other finds no shadow. Its words are the other's.
Technique joined_technique(const Technique& lighting, const Technique& shadowing);

} // namespace shadowproof
