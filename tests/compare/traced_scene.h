// A scene with its truth, traced once for all techniques that are compared with it.
#pragma once

#include "compare/classify.h"
#include "compare/families.h"
#include "raster/render.h"
#include "reference/predict/prediction.h"
#include "scenes/load/catalog.h"
#include "scenes/plan/plan.h"

#include <string>
#include <string_view>
#include <utility>

namespace shadowproof::tests {

/// A bundled scene, seen in a square picture of so many pixels a side.
inline Scene square_scene(const std::string& name, int side) {
    SceneRequest request;
    request.width = request.height = side;
    return load_scene(name, request);
}

struct TracedScene {
    Scene scene;
    Plan plan;
    Tracer tracer;
    GroundTruth truth;
    shadowproof::TracedScene traced;
    const Silhouette& silhouette;
    const ShadowDepths& depths;

    explicit TracedScene(Scene given, int threads = 0)
        : scene(std::move(given)), plan(make_plan(scene)), tracer(scene, threads),
          truth(trace(tracer)), traced(tracer, truth), silhouette(traced.silhouette()),
          depths(traced.depths()) {}
    TracedScene(const TracedScene&) = delete; // the tracer refers to the scene
    TracedScene& operator=(const TracedScene&) = delete;
};

inline Prediction prediction_of(const TracedScene& traced, const Frame& frame) {
    return {traced.traced.volumes(), frame.counted->counting, frame.depth_model};
}

/// The counter at the pixel's centre, as stored.
inline std::uint32_t predicted_counter(const TracedScene& traced, const Frame& frame, int x,
                                       int y) {
    return stored(prediction_of(traced, frame).counts().at(x, y), frame.counted->counting);
}

inline Comparison compared(const TracedScene& traced, const Frame& frame) {
    return classify(traced.traced, frame, *judge_of(traced.traced, frame));
}

inline Comparison compared(const TracedScene& traced, const Technique& technique, Gpu& gpu) {
    return compared(traced, render(technique, traced.scene, traced.plan, gpu));
}

inline Comparison compared(const TracedScene& traced, std::string_view technique, Gpu& gpu) {
    return compared(traced, *find_technique(technique), gpu);
}

using shadowproof::pixels_of;

} // namespace shadowproof::tests
