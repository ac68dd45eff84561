// The family of shadow volumes: claims that were counted, whose counters are predicted by tracing.
#pragma once

#include "compare/judge/judge.h"

namespace shadowproof {

/// "stencil". Its frames have Frame::counted, and surfaces.
Family stencil_family();

} // namespace shadowproof
