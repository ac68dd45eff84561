// Lines of an engine's own language that set its camera and light.
#pragma once

#include "scenes/engines/engine_view.h"

#include <string>
#include <vector>

namespace shadowproof {

/// The code expects the engine's objects `camera` and `light` to exist; in OGRE, also their nodes,
/// `cameraNode` and `lightNode`. `view`: view_in(convention, scene).
std::vector<std::string> engine_code(const Convention& convention, const Scene& scene,
                                     const EngineView& view);

/// Pitch, yaw and roll in degrees, as Unreal's FRotator has them: yaw about z, pitch upwards, roll
/// about x, in the order roll, pitch, yaw. `rotation`: of a node that looks along its x.
glm::dvec3 unreal_rotator(const glm::dquat& rotation);

} // namespace shadowproof
