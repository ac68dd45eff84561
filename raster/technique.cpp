#include "raster/technique.h"

#include <algorithm>
#include <array>

namespace shadowproof {

// Each file of techniques/ defines one.
#define SHADOWPROOF_TECHNIQUE(name) Technique name##_technique();
#include "raster/techniques.inc"
#undef SHADOWPROOF_TECHNIQUE

std::span<const Technique> all_techniques() {
    static const std::array techniques{
#define SHADOWPROOF_TECHNIQUE(name) name##_technique(),
#include "raster/techniques.inc"
#undef SHADOWPROOF_TECHNIQUE
    };
    return techniques;
}

const Technique* find_technique(std::string_view name) {
    const auto techniques = all_techniques();
    const auto found = std::ranges::find(techniques, name, &Technique::name);
    return found == techniques.end() ? nullptr : &*found;
}

} // namespace shadowproof
