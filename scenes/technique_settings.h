// What the user asked of techniques that have settings. Where nothing is asked, each uses its own.
#pragma once

#include "scenes/lighting_settings.h"
#include "scenes/shadow_map.h"
#include "scenes/traced_rays.h"

#include <optional>

namespace shadowproof {

/// In the file's units.
struct VolumeSettings {
    std::optional<double> extrusion{}; ///< how far volumes of finite length reach
};

struct TechniqueSettings {
    VolumeSettings volumes{};
    LightingSettings lighting{};
    MapSettings map{};
    RaySettings rays{};
};

} // namespace shadowproof
