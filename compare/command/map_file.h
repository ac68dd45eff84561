// Writes normal maps to files.
#pragma once

#include "scenes/image.h"

#include <glm/vec4.hpp>
#include <string>

namespace shadowproof {

/// Whether a name ends in .png or .exr, in upper or lower case.
bool is_map_file(const std::string& file);

/// RGBA from 0 to 1, alpha not multiplied in. A .png has `bits` (8 or 16) a channel, each value
/// rounded to the nearest; an .exr 32-bit floats. By write_file; throws Error. The same map gives
/// the same bytes.
void write_map(const Image<glm::dvec4>& map, int bits, const std::string& file);

} // namespace shadowproof
