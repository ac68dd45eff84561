// The casters of a scene, parted by how a technique counts them.
#pragma once

#include "scenes/frame.h"
#include "scenes/scene.h"

#include <vector>

namespace shadowproof {

/// Casters that are all counted alike.
struct CasterPart {
    Counting::Caster caster;
    /// Without what casts no shadow; its meshes no longer say whose triangles are whose.
    Scene scene;
    /// What its triangles are in the scene of all: those past the end of that fill holes.
    std::vector<std::uint32_t> triangles;
    bool turned = false; ///< all of them, in the way of Counting::turned; known where asked for
};

/// One part where all casters are counted alike, else one for each way; none for those left out.
/// The casters are those that the technique makes volumes of, see counted_casters.h.
/// `turned_apart`: turned triangles make parts of their own.
std::vector<CasterPart> caster_parts(const Scene& scene, const Counting& counting,
                                     bool turned_apart);

} // namespace shadowproof
