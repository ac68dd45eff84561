#include "reference/trace/lights_before.h"

#include <utility>

namespace shadowproof {

TracedLight::TracedLight(Scene under, int threads)
    : scene(std::move(under)), tracer(scene, threads), truth(trace(tracer)) {}

TracedLights trace_lights_before(const Tracer& tracer) {
    TracedLights lights;
    for (Scene& under : under_lights_before(tracer.scene()))
        lights.push_back(std::make_unique<TracedLight>(std::move(under), tracer.threads()));
    return lights;
}

} // namespace shadowproof
