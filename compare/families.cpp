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

std::unique_ptr<Judge> judge_of(const TracedScene& traced, const Frame& frame) {
    const auto families = all_families();
    const auto found = std::find_if(families.begin(), families.end(), [&](const Family& family) {
        return family.name == frame.family;
    });
    assert(found != families.end());
    return found->judge(traced, frame);
}

} // namespace shadowproof
