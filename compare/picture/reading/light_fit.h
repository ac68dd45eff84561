// Light and shadow of a mesh, fitted to the pixels that see it.
#pragma once

#include "compare/picture/reading/mesh_light.h"

#include <span>
#include <vector>

namespace shadowproof {

/// What the pixels of a mesh are.
enum class Shown : std::uint8_t {
    differences, ///< from a picture without light
    plain,       ///< colours of one material
    textured,    ///< colours that may be a texture's
};

/// By each of all_normals_by, the best first: others count as well where they fit half as well, but
/// for two steps of the file, and turn no surface away that the picture shows in light; nothing
/// else tells which are the picture's. Of differences shadow is none. Else it is
///   - the typical colour of surfaces that face away from the light;
///   - where none are seen, that of pixels that are certainly in shadow, if the picture shows them
///     darker than lit ones at the same angle;
///   - else the darker of two groups into which pixels at one angle fall.
/// and of a texture that shows in the shadows nothing is told. Light is what is brighter, angle by
/// angle, and as it falls off with distance; certainly lit, where enough pixels are.
/// `blended`: pixels at outlines may show others, too; what is lit nowhere else has no least light.
std::vector<MeshLight> fitted_light(std::span<const Observed* const> pixels, Shown shown,
                                    bool blended = false);

} // namespace shadowproof
