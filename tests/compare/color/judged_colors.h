// Bundled scenes that are lit by bump maps, traced, and the judgement of a technique's colours
// there.
#pragma once

#include "compare/color/color_check.h"
#include "raster/render.h"
#include "scenes/load/catalog.h"
#include "tests/compare/traced_scene.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof::tests {

/// Kept for all tests that ask for it.
inline const TracedScene& traced(const std::string& name, int side) {
    static std::map<std::pair<std::string, int>, std::unique_ptr<TracedScene>> scenes;
    std::unique_ptr<TracedScene>& scene = scenes[{name, side}];
    if (!scene) {
        SceneRequest request;
        request.width = side;
        request.height = side;
        scene = std::make_unique<TracedScene>(load_scene(name, request));
    }
    return *scene;
}

inline std::vector<const Technique*> techniques_for(const Scene& scene) {
    std::vector<const Technique*> techniques;
    for (const Technique& technique : all_techniques())
        if (technique.needs_bump_maps && suits(technique, scene)) techniques.push_back(&technique);
    return techniques;
}

/// Against the means over the pixels where the frame filters.
inline ColorCheck checked_colors(const TracedScene& scene, const Frame& frame) {
    const PixelMeans* const means =
        filters(frame.color_model) ? &scene.traced.pixel_means() : nullptr;
    return check_colors(scene.tracer, scene.truth, frame, {}, means);
}

inline ColorCheck colors_of(const TracedScene& scene, const Technique& technique,
                            const LightingSettings& settings, Gpu& gpu) {
    Plan plan = scene.plan;
    plan.asked.lighting = settings;
    return checked_colors(scene, render(technique, scene.scene, plan, gpu));
}

/// Of a technique at its own settings on a bundled scene.
inline ColorCheck colors_of(const char* scene, const char* technique) {
    Gpu gpu(GlPlatform::osmesa);
    return colors_of(traced(scene, 256), *find_technique(technique), {}, gpu);
}

} // namespace shadowproof::tests
