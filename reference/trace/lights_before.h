// The truth under the lights that are drawn before the chosen one, where a picture adds up what all
// of them give: see added_lights in scene.h.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/scene.h"

#include <memory>
#include <vector>

namespace shadowproof {

/// A scene under one of its lights, traced.
struct TracedLight {
    Scene scene; ///< with that light chosen
    Tracer tracer;
    GroundTruth truth;

    TracedLight(Scene under, int threads);
    TracedLight(const TracedLight&) = delete; // the tracer refers to the scene
    TracedLight& operator=(const TracedLight&) = delete;
};
using TracedLights = std::vector<std::unique_ptr<const TracedLight>>;

/// Those before the tracer's own, in their order; none where the scene is not bump-lit.
TracedLights trace_lights_before(const Tracer& tracer);

} // namespace shadowproof
