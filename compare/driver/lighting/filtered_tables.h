// The mipmaps that filtering techniques read, made a second time from their definitions
// (scenes/surface/bump_pyramid.h), with nothing of bump_pyramid.cpp and mipmap.cpp.
#pragma once

#include "compare/driver/interval.h"
#include "scenes/image.h"
#include "scenes/lighting_settings.h"
#include "scenes/scene.h"

#include <glm/vec4.hpp>
#include <vector>

namespace shadowproof {

/// All levels, from the finest. Means are rounded to floats, as a technique's are, and may fall to
/// either side.
struct ExpectedMipmap {
    std::vector<Image<glm::vec4>> levels{};
    std::vector<RangeOf<glm::dvec4>> bounds{}; ///< of each level's texels
};

struct ExpectedPyramid {
    ExpectedMipmap texels{}; ///< as BumpPyramid::levels
    ExpectedMipmap cross{};  ///< as BumpPyramid::cross
};

/// Of a material that has a bump map.
ExpectedPyramid expected_pyramid(const Scene& scene, const Material& material, BumpFilter filter);

/// Of a picture.
ExpectedMipmap expected_mipmap(const Image<glm::vec4>& texels);

} // namespace shadowproof
