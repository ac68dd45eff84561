// What of a difference of colours a person would see.
#pragma once

#include "scenes/image.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace shadowproof {

/// Pixels at which a person would tell two linear pictures of one size apart, on a screen of 100
/// candela a square metre that fills 45 degrees of sight: after H. Yee, "A Perceptual Metric for
/// Production Testing" (2004), as OpenImageIO has it.
std::uint64_t count_perceptible(const Image<glm::vec3>& one, const Image<glm::vec3>& other);

} // namespace shadowproof
