// The vectors to the light and half way to the eye, where a technique makes them at vertices: in
// the tangent space of each corner, interpolated between them.
#pragma once

#include "compare/driver/interpolated.h"
#include "compare/driver/lighting/vector_range.h"
#include "scenes/lighting_settings.h"
#include "scenes/scene.h"

#include <cstdint>
#include <span>

namespace shadowproof {

/// As interpolated at a pixel, before they are normalised there. In tangent space; of a surface
/// without a bump map in world axes.
struct VertexVectors {
    VectorRange light;
    VectorRange half;
};

/// `corners`: the triangle's, with the tangents that the technique uses. `origin`: not per_pixel.
VertexVectors vertex_vectors(const Scene& scene, std::uint32_t triangle,
                             std::span<const Surface, 3> corners, VectorOrigin origin,
                             const PixelSpread& spread);

} // namespace shadowproof
