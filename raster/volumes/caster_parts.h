// The casters of a scene, grouped by how a technique counts them.
#pragma once

#include "scenes/frame.h"
#include "scenes/scene.h"

#include <vector>

namespace shadowproof {

/// Casters that are all counted alike.
struct CasterPart {
    Counting::Caster caster;
    /// Only these casters. It has no meshes, so it does not say which triangle belongs to which
    /// mesh.
    Scene scene;
    /// Indices of its triangles in the whole scene; indices past its end are triangles that fill
    /// holes.
    std::vector<std::uint32_t> triangles;
    bool flipped = false; ///< all of them are flipped; set only with `flipped_apart`
};

/// One part where all casters are counted alike, else one per way of counting; none for casters
/// left out. The casters are those of counted_casters.h, which also defines `flipped`.
/// `flipped_apart`: flipped triangles are parts of their own.
std::vector<CasterPart> caster_parts(const Scene& scene, const Counting& counting,
                                     const std::vector<std::uint8_t>& flipped, bool flipped_apart);

} // namespace shadowproof
