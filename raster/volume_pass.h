// The ways in which the faces of shadow volumes come to be drawn: made on the CPU for each position
// of the light, or by shaders from what is uploaded once.
#pragma once

#include "raster/passes.h"
#include "raster/volume.h"
#include "scenes/scene.h"

#include <functional>
#include <vector>

namespace shadowproof {

enum class VolumeMaking : std::uint8_t {
    on_cpu,           ///< by an Extruder
    degenerate_quads, ///< a quad for each edge, stretched out by the vertex shader
    geometry_shader,  ///< of triangles with adjacency
};

/// Which caps are drawn with the sides.
struct VolumeCaps {
    bool light = true;
    bool dark = true;
};

/// The volume's faces, ready to be drawn again and again.
struct VolumePass {
    /// What has to be done anew when the light moves.
    std::function<void()> update;
    /// Draws sides, then light caps, then dark caps, as `caps` has them. Binds its programs and
    /// buffers; all other state is the caller's.
    std::function<void()> draw;
    /// Draws those sides whose front and back are exchanged (ShadowVolume::turned_sides).
    std::function<void()> draw_turned;
    std::vector<GLuint> programs; ///< all that it draws faces with
};

/// What a face adds to a colour that counts or shows it, seen from either side.
void set_worth(const GlFunctions& gl, const VolumePass& pass, float front, float back);

/// Keeps references to all but `caps`; corners at a volume's far end are transformed as
/// set_transform says. `surfaces`: how those are drawn whose depths the light caps must have.
/// Throws Error where the driver fails.
VolumePass make_volume_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                            const ClipTransform& transform, const VolumeCaps& caps,
                            VolumeMaking making, Between surfaces, const Extruder& extruder);

} // namespace shadowproof
