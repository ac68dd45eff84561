// What the user asked of techniques that have settings. Where nothing is asked, each uses its own.
#pragma once

#include "scenes/lighting_settings.h"
#include "scenes/shadow_map.h"
#include "scenes/traced_rays.h"

namespace shadowproof {

struct TechniqueSettings {
    LightingSettings lighting{};
    MapSettings map{};
    RaySettings rays{};
};

} // namespace shadowproof
