// Alpha masks as a float ray tracer reads them: in single precision throughout.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowproof {

/// Whether the mask leaves the triangle standing at a hit with these weights of its second and
/// third corner. The triangle must have a mask, of this index.
bool stands_at(const Scene& scene, std::uint32_t mask, std::uint32_t triangle,
               const glm::vec2& weights);

} // namespace shadowproof
