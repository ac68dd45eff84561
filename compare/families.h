// The families of claims by name.
#pragma once

#include "compare/judge/judge.h"

#include <memory>
#include <span>
#include <string_view>

namespace shadowproof {

/// All families in the order of the registry, families.inc.
std::span<const Family> all_families();

/// Null where no family has that name.
const Family* find_family(std::string_view name);

/// Throws Error where what was asked for takes more memory than there is, in any family.
void require_memory(const MemoryBudget& budget, const TechniqueSettings& asked);

/// The judge of a claim, by its family; keeps references to both. Asserts that the family is known.
std::unique_ptr<Judge> judge_of(const TracedScene& traced, const Frame& frame);

} // namespace shadowproof
