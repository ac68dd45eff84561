// Which pixels' claims depend on whether something is in the light's way.
#pragma once

#include "compare/judge/judge.h"

namespace shadowproof {

/// Whether the surface that is truly seen at a pixel faces the light, lies in its cone and receives
/// shadows: whatever else is seen is dark, or lit, or background without asking.
bool depends_on_shadow(const TracedScene& traced, PixelPlace p);

} // namespace shadowproof
