// The memory that a shadow map takes, beside that of compare/memory.h.
#pragma once

#include "scenes/memory_budget.h"
#include "scenes/technique_settings.h"

namespace shadowproof {

/// Throws Error naming --map-size where a map that was asked for cannot fit.
void require_map(const MemoryBudget& budget, const TechniqueSettings& asked);

} // namespace shadowproof
