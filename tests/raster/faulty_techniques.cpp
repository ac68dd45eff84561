#include "tests/raster/faulty_techniques.h"

#include "raster/volumes/stencil.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof::tests {

namespace {

/// An extruder whose volumes are then tampered with.
template <class Tamper>
std::function<Extruder(const Scene&)> tampered(const Tamper& tamper) {
    return [tamper](const Scene& scene) -> Extruder {
        return [&scene, tamper, extrude = by_silhouettes(scene)] {
            ShadowVolume volume = extrude();
            tamper(scene, volume);
            return volume;
        };
    };
}

StencilRecipe clamp_recipe(const Scene& scene) {
    return {.counting =
                {
                    .test = Counting::Test::depth_fail,
                },
            .depth_model = {.near = scene.camera.near, .far = finite_far(scene), .clamp = true}};
}

/// Index of the first of the two triangles (b, a, a'), (b, a', b') beside the longest edge.
std::ptrdiff_t longest_side(const Scene& scene, const std::vector<glm::uvec3>& sides) {
    std::ptrdiff_t longest = 0;
    float most = -1;
    for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
        const float length =
            glm::distance(scene.positions[sides[i].x], scene.positions[sides[i].y]);
        if (length > most) {
            most = length;
            longest = static_cast<std::ptrdiff_t>(i);
        }
    }
    return longest;
}

} // namespace

Frame without_dark_cap(Gpu& gpu, const Scene& scene, const Plan& plan) {
    StencilRecipe recipe = zfail_reversed_recipe(scene, plan);
    recipe.counting.dark_cap = true;
    recipe.extruder = tampered([](const Scene&, ShadowVolume& volume) { volume.dark_cap.clear(); });
    return draw_stencil_shadows(gpu, scene, recipe);
}

Frame with_swapped_steps(Gpu& gpu, const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe recipe = clamp_recipe(scene);
    // What is flipped is counted with exchanged steps.
    recipe.extruder = tampered([](const Scene&, ShadowVolume& volume) {
        std::swap(volume.sides, volume.flipped_sides);
        for (auto* caps : {&volume.light_cap, &volume.dark_cap}) {
            volume.flipped_sides.insert(volume.flipped_sides.end(), caps->begin(), caps->end());
            caps->clear();
        }
    });
    return draw_stencil_shadows(gpu, scene, recipe);
}

Frame without_one_side(Gpu& gpu, const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe recipe = clamp_recipe(scene);
    recipe.extruder = tampered([](const Scene& casters, ShadowVolume& volume) {
        if (volume.sides.empty()) return;
        const auto first = volume.sides.begin() + longest_side(casters, volume.sides);
        volume.sides.erase(first, first + 2);
    });
    return draw_stencil_shadows(gpu, scene, recipe);
}

Frame with_wrong_near_plane(Gpu& gpu, const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe recipe = zpass_recipe(scene);
    Scene drawn = scene;
    drawn.camera.near *= 2;
    recipe.depth_model.near *= 2;
    Frame frame = draw_stencil_shadows(gpu, drawn, recipe);
    frame.depth_model.near = scene.camera.near;
    return frame;
}

Frame with_mirrored_light(Gpu& gpu, const Scene& scene, const Plan& /*plan*/) {
    Scene mirrored = scene;
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (const glm::vec3& position : scene.positions) {
        low = std::min(low, position.x);
        high = std::max(high, position.x);
    }
    double& x = mirrored.lights[mirrored.light].position.x;
    x = double{low} + double{high} - x;
    return draw_stencil_shadows(gpu, mirrored,
                                zfail_reversed_recipe(mirrored, make_plan(mirrored)));
}

Frame with_all_caps_hidden(Gpu& gpu, const Scene& scene, const Plan& /*plan*/) {
    StencilRecipe recipe = zpass_recipe(scene);
    recipe.hidden_caps.assign(scene.triangles.size(), 1);
    return draw_stencil_shadows(gpu, scene, recipe);
}

std::span<const Technique> faulty_techniques() {
    static const auto like = [](const char* twin, const char* name,
                                Frame (*run)(Gpu&, const Scene&, const Plan&)) {
        Technique technique = *find_technique(twin);
        technique.name = name;
        technique.recipe = nullptr; // it draws in a way of its own
        technique.run = run;
        return technique;
    };
    static const std::array techniques{
        like("zfail_reversed", "without_dark_cap", without_dark_cap),
        like("zfail_clamp", "with_swapped_steps", with_swapped_steps),
        like("zfail_clamp", "without_one_side", without_one_side),
        like("zpass", "with_wrong_near_plane", with_wrong_near_plane),
        like("zfail_reversed", "with_mirrored_light", with_mirrored_light),
        like("zpass", "with_all_caps_hidden", with_all_caps_hidden),
    };
    return techniques;
}

} // namespace shadowproof::tests
