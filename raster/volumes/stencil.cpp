#include "raster/volumes/stencil.h"

#include "raster/gl/stage_clock.h"
#include "raster/passes/kept_claims.h"
#include "raster/volumes/counted_light.h"
#include "scenes/plan/plan.h"

#include <algorithm>
#include <cassert>
#include <memory>

namespace shadowproof {

namespace {

/// What one frame is drawn with: the chosen light and, where bumps are lit, those before it.
struct Frames {
    const GlFunctions& gl;
    const Scene& scene;
    Target target;
    std::vector<std::unique_ptr<CountedLight>> lights; ///< the chosen one last
    KeptClaims claims;
    std::vector<LightingPass> lighting; ///< one per light, or none

    Frames(Gpu& gpu, const Scene& drawn, const StencilRecipe& with,
           std::span<const StencilLight> before)
        : gl(gpu.gl()), scene(drawn),
          target(make_target(gl, drawn.camera, with.depth_model.floating)) {
        add_sum(gl, target);
        for (const StencilLight& light : before)
            lights.push_back(std::make_unique<CountedLight>(gl, light.scene, light.recipe, target));
        lights.push_back(std::make_unique<CountedLight>(gl, drawn, with, target));
        claims = make_kept_claims(gl, target, lights.size());
        if (with.lighting) {
            add_color(gl, target,
                      with.lighting->model.arithmetic != ColorModel::Arithmetic::floating);
            for (const auto& light : lights)
                lighting.push_back(make_lighting_pass(
                    gl, light->scene(), light->transform(), *with.lighting, light->between(),
                    lighting.empty() ? nullptr : &lighting.front()));
        }
        check(gl, "making the passes");
    }
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    /// Counts a light's volumes, and shows where it is lit.
    void draw_shadows(std::size_t light, StageClock& clock) {
        lights[light]->count();
        clock.end("counting");
        lights[light]->draw_lit();
        keep_claim(gl, target, claims, light);
        clock.end("classes");
    }

    /// Once more, or of another light, over the same surfaces.
    void draw_shadows_anew(std::size_t light, StageClock& clock) {
        lights[light]->begin();
        lights[light]->clear_stencil();
        take_unlit(gl, target, claims);
        draw_shadows(light, clock);
    }

    void draw(StageClock& clock) {
        for (const auto& light : lights) light->update();
        clock.end("volumes");
        lights.front()->begin();
        lights.front()->draw_surfaces();
        keep_unlit(gl, target, claims);
        clock.end("surface");
        draw_shadows(0, clock);
        if (lighting.empty()) return;
        draw_lighting(gl, lighting, scene, target, [&](std::size_t light) {
            clock.end("lighting");
            draw_shadows_anew(light, clock);
        });
        lights.back()->begin(); // what is drawn to show the volumes needs their vertices
        clock.end("lighting");
    }
};

/// Which faces are drawn, for predicting the technique's figures.
VolumeFaces faces_of(const StencilRecipe& recipe) {
    const bool by_shaders = recipe.making != VolumeMaking::on_cpu;
    return {.sides = by_shaders ? VolumeFaces::Sides::half_edges : recipe.sides,
            .by_shaders = by_shaders,
            .near_plane = recipe.near_plane,
            .hidden_caps = recipe.hidden_caps};
}

} // namespace

Frame draw_stencil_shadows(Gpu& gpu, const Scene& scene, const StencilRecipe& recipe,
                           std::span<const StencilLight> before) {
    assert(recipe.counting.casters.empty() ||
           (recipe.near_plane == NearPlane::lost &&
            recipe.counting.start == Counting::Start::zero)); // which take all casters as one part
    assert(recipe.counter == Counter::stencil ||
           (recipe.counting.operation == Counting::Operation::wrap &&
            recipe.counting.start == Counting::Start::zero && recipe.counting.bits == 24));
    assert(!recipe.lighting || recipe.counter == Counter::stencil);
    assert(std::ranges::all_of(before, [&](const StencilLight& light) {
        return recipe.lighting && light.recipe.depth_model == recipe.depth_model &&
               light.recipe.making == recipe.making;
    }));
    Frames frames(gpu, scene, recipe, before);
    const GlFunctions& gl = gpu.gl();
    const auto draw = [&](StageClock& clock) { frames.draw(clock); };
    compile_all(gl, draw);
    const FrameTime time = quickest_frame(gl, gpu.timed_frames(), gpu.tells_stages(), draw);
    Frame frame = read_back(gl, frames.target, recipe.counter);
    if (recipe.lighting) {
        frame.color = read_color(gl, frames.target);
        frame.color_model = recipe.lighting->model;
        frame.color_model.bytes = gpu.byte_errors();
    }
    frame.claims_before = read_claims(gl, frames.target, frames.claims);
    frame.family = "stencil";
    frame.counted->counting = recipe.counting;
    frame.counted->volume_faces = faces_of(recipe);
    frame.depth_model = recipe.depth_model;
    frame.depth_model.subpixel_bits = gpu.driver().subpixel_bits;
    frame.milliseconds = time.milliseconds;
    frame.stages = time.stages;
    frames.lights.back()->measure(frame);
    end_frame(gl);
    return frame;
}

DepthModel finite_depths(const Scene& scene) noexcept {
    return {.projection = DepthModel::Projection::finite,
            .near = scene.camera.near,
            .far = finite_far(scene),
            .parallel = scene.camera.is_orthographic()};
}

DepthModel infinite_depths(const Scene& scene) noexcept {
    return {.projection = DepthModel::Projection::infinite, .near = scene.camera.near};
}

DepthModel reversed_depths(const Scene& scene) noexcept {
    if (scene.camera.is_orthographic()) {
        DepthModel model = reversed_parallel_depths(scene);
        model.clamp = true; // volumes reach to infinity
        return model;
    }
    return {.projection = DepthModel::Projection::infinite_reversed,
            .near = scene.camera.near,
            .floating = true,
            .eye_relative = true};
}

StencilRecipe zpass_recipe(const Scene& scene) {
    return {.counting = {.test = Counting::Test::depth_pass, .dark_cap = false},
            .depth_model = finite_depths(scene)};
}

StencilRecipe zfail_recipe(const Plan& plan, const DepthModel& depth_model) {
    return {.counting = {.test = Counting::Test::depth_fail,
                         .dark_cap = plan.dark_cap,
                         .flips = {.around_light = true}},
            .depth_model = depth_model,
            .flipped = plan.around_light};
}

StencilRecipe zfail_reversed_recipe(const Scene& scene, const Plan& plan) {
    return zfail_recipe(plan, reversed_depths(scene));
}

} // namespace shadowproof
