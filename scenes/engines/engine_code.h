// Lines of an engine's own language that set its camera and light.
#pragma once

#include "scenes/engines/engine_view.h"

#include <string>
#include <vector>

namespace shadowproof {

/// `camera` and `light` are objects of the engine that are there already; in OGRE, `cameraNode` and
/// `lightNode` their nodes. `view`: view_in(convention, scene).
std::vector<std::string> engine_code(const Convention& convention, const Scene& scene,
                                     const EngineView& view);

/// Pitch, yaw and roll in degrees, as Unreal's FRotator has them: yaw about z, pitch upwards, roll
/// about x, in the order roll, pitch, yaw. `rotation`: of a node that looks along its x.
glm::dvec3 unreal_rotator(const glm::dquat& rotation);

} // namespace shadowproof
