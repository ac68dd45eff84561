// The casters of a scene, parted by how a technique counts them.
#pragma once

#include "scenes/frame.h"
#include "scenes/scene.h"

#include <vector>

namespace shadowproof {

/// Casters that are all counted alike.
struct CasterPart {
    Counting::Caster caster;
    Scene
        scene; ///< without what casts no shadow; its meshes no longer say whose triangles are whose
};

/// One part where all casters are counted alike, else one for each way; none for those left out.
/// Holes are filled where the counting asks for it.
std::vector<CasterPart> caster_parts(const Scene& scene, const Counting& counting);

} // namespace shadowproof
