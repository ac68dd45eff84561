#include "raster/render.h"

#include "raster/maps/map_shadows.h"
#include "raster/volumes/stencil.h"
#include "scenes/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace shadowproof {

namespace {

void require_drawable(const DriverInfo& driver) {
    constexpr int llvmpipe_subpixel_bits = 8;
    if (driver.subpixel_bits < llvmpipe_subpixel_bits)
        throw Error("OpenGL",
                    driver.renderer + " snaps vertices to " + std::to_string(driver.subpixel_bits) +
                        " bits of a pixel",
                    "use a driver with at least 8 (llvmpipe)");
}

/// Whether a depth is in [0, 1]; false for NaN.
bool is_window_depth(float depth) {
    return depth >= 0 && depth <= 1;
}

bool is_color(const glm::vec3& color) {
    return std::isfinite(color.r) && std::isfinite(color.g) && std::isfinite(color.b);
}

/// Whether a pixel's claim is a class; a part of the light must be neither all nor nothing of it.
bool is_class(const Frame& frame, std::size_t pixel) {
    switch (frame.claim.pixels[pixel]) {
    case Visibility::background:
    case Visibility::shadowed:
    case Visibility::lit:
        return true;
    case Visibility::partly_lit:
        return pixel < frame.share.pixels.size() && frame.share.pixels[pixel] > 0 &&
               frame.share.pixels[pixel] < 1;
    }
    return false;
}

void require_picture(const Frame& frame, const Scene& scene, std::string_view technique) {
    const auto refuse = [&](const char* what) {
        throw Error(std::string(technique), "the driver's " + std::string(what), "use --gl osmesa");
    };
    if (!std::ranges::all_of(frame.depth.pixels, is_window_depth))
        refuse("picture holds depths that are NaN or outside [0, 1]");
    if (!std::ranges::all_of(frame.color.pixels, is_color))
        refuse("picture holds colours that are NaN or infinite");
    if (!std::ranges::all_of(frame.triangle.pixels, [&](std::uint32_t triangle) {
            return triangle < scene.triangles.size() || triangle == no_triangle;
        }))
        refuse("picture shows triangles that the scene does not have");
    for (std::size_t i = 0; i < frame.claim.pixels.size(); ++i)
        if (!is_class(frame, i)) refuse("claim is neither background nor shadowed nor lit");
}

[[noreturn]] void refuse_scene(const Technique& technique, const Scene& scene) {
    const std::string file = scene.file.empty() ? scene.name : scene.file.string();
    const std::string name(technique.name);
    if (const Light* light = unsuited_light(technique, scene))
        throw Error(file, "has a light that is not one for " + name + ": " + light->choice,
                    "leave the technique out; it needs " + std::string(technique.needs));
    if (scene.camera.is_orthographic() && !technique.sees_in_parallel)
        throw Error(file,
                    "has an orthographic camera, and " + name + " draws from perspective ones",
                    "leave the technique out, or choose another camera with --camera");
    if (!is_bump_lit(scene))
        throw Error(file, "has no bump map, and " + name + " is for those that do",
                    "leave the technique out, or give a material a normalTexture");
    if (technique.needs_environment)
        throw Error(file, "has no environment, and " + name + " is for those that do",
                    "leave the technique out, or give the file an extras.shadowproof.environment");
    if (technique.squares_thrice && scene.highlight.exponent() != 8)
        throw Error(file,
                    "has highlights of the exponent " + std::to_string(scene.highlight.exponent()) +
                        ", and those of " + name + " have 8",
                    "leave the technique out, or extras.shadowproof.highlight.exponent at 8");
    throw Error(file, "has an environment, which " + name + " does not reflect",
                "name bump_reflective, or take extras.shadowproof.environment out of the file");
}

/// A recipe for each light, the chosen one last, all to the same depths: the surfaces are drawn
/// once.
std::vector<StencilRecipe> recipes_of(const Technique& technique, const Scene& scene,
                                      const std::vector<Scene>& others, const Plan& plan) {
    std::vector<Plan> plans;
    for (const Scene& other : others) {
        plans.push_back(make_plan(other));
        plans.back().asked = plan.asked;
    }
    plans.push_back(plan);
    const auto made = [&] {
        std::vector<StencilRecipe> recipes;
        for (std::size_t i = 0; i < plans.size(); ++i)
            recipes.push_back(technique.recipe(i < others.size() ? others[i] : scene, plans[i]));
        return recipes;
    };
    std::vector<StencilRecipe> recipes = made();
    if (std::ranges::all_of(recipes, [&](const StencilRecipe& recipe) {
            return recipe.depth_model == recipes.back().depth_model;
        }))
        return recipes;
    for (Plan& each : plans) each.to_infinity = true;
    return made();
}

Frame draw_by_stencil(Gpu& gpu, const Technique& technique, const Scene& scene, const Plan& plan) {
    if (technique.lighting == nullptr)
        return draw_stencil_shadows(gpu, scene, technique.recipe(scene, plan));
    const std::vector<Scene> others = under_lights_before(scene);
    std::vector<StencilRecipe> recipes = recipes_of(technique, scene, others, plan);
    StencilRecipe recipe = std::move(recipes.back());
    recipe.lighting = technique.lighting(plan);
    std::vector<StencilLight> before;
    for (std::size_t i = 0; i < others.size(); ++i)
        before.push_back({others[i], std::move(recipes[i])});
    return draw_stencil_shadows(gpu, scene, recipe, before);
}

} // namespace

Frame draw_with(Gpu& gpu, const Technique& technique, const Scene& scene, const Plan& plan) {
    if (technique.map != nullptr) {
        MapRecipe recipe = technique.map();
        if (technique.lighting != nullptr) recipe.lighting = technique.lighting(plan);
        return draw_map_shadows(gpu, scene, plan, recipe);
    }
    if (technique.recipe == nullptr) return technique.run(gpu, scene, plan);
    Frame frame = draw_by_stencil(gpu, technique, scene, plan);
    if (technique.remark != nullptr) technique.remark(gpu, technique, scene, plan, frame);
    return frame;
}

Frame render(const Technique& technique, const Scene& scene, const Plan& plan, Gpu& gpu) {
    if (!can_draw(technique, scene)) refuse_scene(technique, scene);
    require_drawable(gpu.driver());
    gpu.make_current();
    Frame frame = draw_with(gpu, technique, scene, plan);
    require_picture(frame, scene, technique.name);
    return frame;
}

} // namespace shadowproof
