// A scene with its truth, traced once for all techniques that are compared with it.
#pragma once

#include "compare/classify.h"
#include "raster/render.h"
#include "scenes/plan.h"

#include <string_view>
#include <utility>

namespace shadowproof::tests {

struct TracedScene {
    Scene scene;
    Plan plan;
    Tracer tracer;
    Silhouette silhouette;
    GroundTruth truth;
    ShadowDepths depths;

    explicit TracedScene(Scene given)
        : scene(std::move(given)), plan(make_plan(scene)), tracer(scene), silhouette(tracer),
          truth(trace(tracer)), depths(count_shadow_depths(tracer, truth, finite_far(scene))) {}
    TracedScene(const TracedScene&) = delete; // the tracer refers to the scene
    TracedScene& operator=(const TracedScene&) = delete;
};

inline Comparison compared(const TracedScene& traced, const Frame& frame) {
    return classify(traced.tracer, traced.silhouette, traced.truth, traced.depths, frame,
                    {traced.tracer, traced.silhouette, traced.truth, traced.depths, frame.counting,
                     frame.depth_model});
}

inline Comparison compared(const TracedScene& traced, const Technique& technique, Gpu& gpu) {
    return compared(traced, render(technique, traced.scene, traced.plan, gpu));
}

inline Comparison compared(const TracedScene& traced, std::string_view technique, Gpu& gpu) {
    return compared(traced, *find_technique(technique), gpu);
}

inline std::uint64_t pixels_of(const Comparison& comparison, Cause cause) {
    return comparison.causes[static_cast<std::size_t>(cause)];
}

} // namespace shadowproof::tests
