// Shadow maps drawn with settings, and their texels against the prediction, as tests of this folder
// do it.
#pragma once

#include "compare/maps/light_view.h"
#include "raster/maps/map_shadows.h"
#include "tests/compare/traced_scene.h"
#include "tests/scenes/bundled_names.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof::tests {

inline Scene small(const std::string& name, int size = 128) {
    Scene scene = load_named(name);
    scene.camera.width = size;
    scene.camera.height = size;
    return scene;
}

inline Frame drawn(Gpu& gpu, const TracedScene& traced, const std::string& technique,
                   const MapSettings& settings) {
    Plan plan = traced.plan;
    plan.asked.map = settings;
    return render(*find_technique(technique), traced.scene, plan, gpu);
}

inline std::vector<Texel> all_texels(const MapModel& model) {
    std::vector<Texel> texels;
    for (std::uint32_t face = 0; face < model.faces(); ++face)
        for (int y = 0; y < model.size; ++y)
            for (int x = 0; x < model.size; ++x) texels.push_back({face, x, y});
    return texels;
}

inline std::uint64_t texels_not_shown(const TracedScene& traced, const Frame& frame) {
    const std::unique_ptr<LightView> light =
        light_view(traced.scene, *frame.mapped, frame.depth_model.subpixel_bits, 0);
    const std::vector<Texel> texels = all_texels(frame.mapped->model);
    std::atomic<std::uint64_t> wrong{0};
    light->trace(texels, [&](std::size_t i, std::uint32_t at_centre) {
        wrong += light->shown(texels[i], at_centre) ? 0 : 1;
    });
    return wrong;
}

} // namespace shadowproof::tests
