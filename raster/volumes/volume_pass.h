// The ways in which the faces of shadow volumes are made and drawn: on the CPU for each position of
// the light, or by shaders from what is uploaded once.
#pragma once

#include "raster/passes/passes.h"
#include "raster/volumes/volume.h"
#include "scenes/scene.h"

#include <functional>
#include <vector>

namespace shadowproof {

enum class VolumeMaking : std::uint8_t {
    on_cpu,           ///< by an Extruder
    degenerate_quads, ///< a quad per edge, extruded by the vertex shader
    geometry_shader,  ///< of triangles with adjacency
};

/// Which caps are drawn with the sides.
struct VolumeCaps {
    bool light = true;
    bool dark = true;
};

/// A volume's faces, ready to be drawn repeatedly.
struct VolumePass {
    /// What must be done again when the light moves.
    std::function<void()> update;
    /// Draws sides, then light caps, then dark caps, as `caps` says. Binds its programs and
    /// buffers; all other state is the caller's.
    std::function<void()> draw;
    /// Draws the faces whose front and back are exchanged (ShadowVolume::flipped_sides,
    /// flipped_caps).
    std::function<void()> draw_flipped;
    std::vector<GLuint> programs; ///< all programs that it draws faces with
};

/// Sets what a front face and a back face add to a colour that counts or shows them.
void set_worth(const GlFunctions& gl, const VolumePass& pass, float front, float back);

/// Keeps references to all but `caps`; corners at a volume's far end are transformed as by
/// set_transform. `surfaces`: how the surfaces are drawn whose depths the light caps must match.
/// Throws Error where the driver fails.
VolumePass make_volume_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                            const ClipTransform& transform, const VolumeCaps& caps,
                            VolumeMaking making, Between surfaces, const Extruder& extruder);

} // namespace shadowproof
