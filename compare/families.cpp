#include "compare/families.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace shadowproof {

#define SHADOWPROOF_FAMILY(name) Family name##_family();
#include "compare/families.inc"
#undef SHADOWPROOF_FAMILY

std::span<const Family> all_families() {
    static const std::array families{
#define SHADOWPROOF_FAMILY(name) name##_family(),
#include "compare/families.inc"
#undef SHADOWPROOF_FAMILY
    };
    return families;
}

const Family* find_family(std::string_view name) {
    const auto families = all_families();
    const auto found = std::ranges::find(families, name, &Family::name);
    return found == families.end() ? nullptr : &*found;
}

void require_memory(const MemoryBudget& budget, const TechniqueSettings& asked) {
    for (const Family& family : all_families())
        if (family.require_memory != nullptr) family.require_memory(budget, asked);
}

std::unique_ptr<Judge> judge_of(const TracedScene& traced, const Frame& frame) {
    const Family* const family = find_family(frame.family);
    assert(family != nullptr);
    return family->judge(traced, frame);
}

} // namespace shadowproof
