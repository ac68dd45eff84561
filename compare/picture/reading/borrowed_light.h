// Light and shadow of a mesh that shows light alone, by another one that is lit as it is.
#pragma once

#include "compare/picture/reading/mesh_light.h"

#include <span>
#include <vector>

namespace shadowproof {

/// What a mesh shows: of each group of pixels that are certainly lit, or certainly in shadow, at
/// about one angle, the pixel of median brightness, which a few false ones do not change. By
/// growing angles.
struct MeshSamples {
    std::vector<const Observed*> lit;
    std::vector<const Observed*> shadowed;
    double step = 0; ///< the largest of theirs
};

/// Keeps pointers to the pixels.
MeshSamples mesh_samples(std::span<const Observed* const> pixels);

/// A mesh whose light and shadow are known.
struct KnownLight {
    MeshLight fit; ///< the best, without highlights: those of another mesh lie at other angles
    MeshSamples shown;
};

KnownLight known_light(MeshLight fit, std::span<const Observed* const> pixels);

/// Fits, by all normals, of the mesh that shows the same colours at the same angles; none where
/// there is no such mesh. All that is shown must be its light, or, of what is certainly in shadow,
/// its shadow; and the light at two angles must differ by four times what tells light from shadow,
/// as materials of which one is brighter in shadow may look alike at one angle.
std::vector<MeshLight> borrowed_light(const MeshSamples& shown, std::span<const KnownLight> known);

} // namespace shadowproof
