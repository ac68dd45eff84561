// What the pixels of a picture see, and how their surfaces lie to the light.
#pragma once

#include "compare/picture/reading/mesh_light.h"
#include "reference/predict/traced_scene.h"
#include "scenes/image.h"

#include <cstdint>
#include <optional>

namespace shadowproof {

/// A pixel that sees a surface.
struct Seen {
    std::uint32_t mesh = 0;
    Observed observed;
};

using SeenPixels = Image<std::optional<Seen>>;

/// All but their colours.
SeenPixels seen_pixels(const TracedScene& traced);

} // namespace shadowproof
