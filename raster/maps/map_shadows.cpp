#include "raster/maps/map_shadows.h"

#include "raster/gl/stage_clock.h"
#include "raster/maps/offset_unit.h"
#include "raster/passes/claim_in_stencil.h"
#include "raster/passes/kept_claims.h"

#include <algorithm>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <vector>

namespace shadowproof {

namespace {

DepthModel eye_depth_model(const Scene& scene) {
    if (scene.camera.is_orthographic()) return reversed_parallel_depths(scene);
    return {.projection = DepthModel::Projection::infinite_reversed,
            .near = scene.camera.near,
            .floating = true,
            .eye_relative = true};
}

/// What the projection does not clip by itself.
VisibleDepths visible_depths(const Camera& camera) {
    if (camera.is_orthographic()) return {};
    return {static_cast<float>(camera.near), static_cast<float>(camera.far)};
}

/// Sets how the light pass asks the map.
void set_test(const GlFunctions& gl, const Program& light, const Scene& scene,
              const MapModel& model) {
    // Locations as map_test.glsl, map_block.glsl and the shaders of the light pass lay them out.
    gl.ProgramUniform1f(light.name(), 15, static_cast<float>(model.bias));
    gl.ProgramUniform2f(light.name(), 16, static_cast<float>(model.near),
                        static_cast<float>(model.far));
    if (!model.is_ramp()) {
        gl.ProgramUniform1i(light.name(), 17, model.value == MapValue::distance ? 1 : 0);
        gl.ProgramUniform1i(light.name(), 23, model.shape == MapModel::Shape::sun ? 1 : 0);
    }
    if (model.shape != MapModel::Shape::cube) {
        const glm::mat3 matrix = map_from_world(map_camera(chosen_light(scene), model, 0));
        gl.ProgramUniformMatrix3fv(light.name(), 18, 1, GL_FALSE, glm::value_ptr(matrix));
    }
    if (model.filter > 0) {
        gl.ProgramUniform1i(light.name(), 21, model.filter);
        gl.ProgramUniform1i(light.name(), 22, model.average == MapAverage::values ? 1 : 0);
        if (model.shape == MapModel::Shape::cube)
            gl.ProgramUniform1i(light.name(), 24, model.edges == MapEdges::seamless ? 1 : 0);
    }
}

std::string_view light_shader(const MapModel& model) {
    if (model.shape == MapModel::Shape::cube)
        return model.filter > 0 ? "map_light_cube_filtered.frag" : "map_light_cube.frag";
    if (model.shape == MapModel::Shape::sun) return "map_light_sun.frag";
    if (model.is_ramp()) return "map_light_ramp.frag";
    return model.filter > 0 ? "map_light_spot_filtered.frag" : "map_light_spot.frag";
}

/// How the light pass transforms. A sun has no position: points are relative to its camera's eye.
ClipTransform light_transform(const Scene& scene, const DepthModel& depth_model,
                              const MapModel& model) {
    ClipTransform transform = clip_transform(scene, depth_model);
    if (model.shape == MapModel::Shape::sun) {
        transform.light = split(map_camera(chosen_light(scene), model, 0).eye);
        transform.light_w = 1;
    }
    return transform;
}

// All counts of comparisons lie between both.
static_assert(static_cast<int>(Visibility::shadowed) + largest_map_filter * largest_map_filter <=
              static_cast<int>(Visibility::lit));

/// The shares of comparisons that say `lit`, whose number map_block.glsl adds to
/// `shadowed`, taken out of the claim.
Image<double> take_shares(const MapModel& model, Image<Visibility>& claim) {
    Image<double> shares(claim.width, claim.height);
    for (std::size_t i = 0; i < claim.pixels.size(); ++i) {
        const auto byte = static_cast<std::uint8_t>(claim.pixels[i]);
        const int lit = byte - static_cast<int>(Visibility::shadowed);
        if (claim.pixels[i] == Visibility::lit) shares.pixels[i] = 1;
        if (lit <= 0 || lit >= model.asked()) continue;
        shares.pixels[i] = 1.0 * lit / model.asked();
        claim.pixels[i] = Visibility::partly_lit;
    }
    return shares;
}

/// Draws the receivers' lit sides that the map shows to be shadowed into the stencil buffer, as 1.
void draw_into_stencil(const GlFunctions& gl, const Program& shadow, const Target& target,
                       const Geometry& geometry) {
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(GL_EQUAL);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilMask(~0U);
    gl.StencilFunc(GL_ALWAYS, 1, ~0U);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    gl.Disable(GL_CULL_FACE);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.light.name());
    gl.UseProgram(shadow.name());
    gl.BindTextureUnit(0, target.triangle.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, geometry.lit_side_indices.name());
    gl.ProgramUniform1ui(shadow.name(), 7, 0);
    draw_triangles(gl, geometry, geometry.lit_sides, 0, geometry.receivers);
    check(gl, "drawing a map's shadows into the stencil");
}

/// One light over a scene, and its map.
struct MappedLight {
    const GlFunctions& gl;
    const Scene& scene; ///< with it chosen
    bool in_stencil;
    Geometry geometry;
    MapPass map;
    Program shadow{}; ///< asks the map, where the stencil keeps the answer
    Program light{};  ///< asks the map, or the stencil

    MappedLight(const GlFunctions& functions, const Scene& under, const MapModel& model,
                const MapRecipe& recipe)
        : gl(functions), scene(under), in_stencil(recipe.in_stencil),
          geometry(upload(gl, under, {})),
          map(make_map_pass(gl, under, geometry, model, recipe.making)) {
        const auto link_pass = [&](std::string_view shader) {
            return link_light(gl, under, light_transform(under, eye_depth_model(under), model),
                              geometry, Between::nothing, shader);
        };
        light = link_pass(in_stencil ? "light.frag" : light_shader(model));
        if (in_stencil) shadow = link_pass("map_stencil_spot.frag");
        set_test(gl, in_stencil ? shadow : light, under, model);
    }

    /// Shows what is lit as such. Surfaces must be drawn.
    void draw_lit(const Target& target) const {
        gl.BindTextureUnit(2, map.texture.name());
        gl.BindTextureUnit(3, map.ramp.name()); // lighting binds another there
        if (in_stencil) draw_into_stencil(gl, shadow, target, geometry);
        draw_light(gl, light, target, geometry, in_stencil ? Counter::stencil : Counter::none);
        gl.BindTextureUnit(2, 0);
        gl.BindTextureUnit(3, 0);
    }
};

MapModel model_of(const MapRecipe& recipe, const Plan& plan, const Scene& scene) {
    return with_settings(recipe.model, plan.asked.map, scene);
}

/// What one frame is drawn with: the chosen light and, where bumps are lit, those before it.
struct Frames {
    const GlFunctions& gl;
    const Scene& scene;
    DepthModel depth_model;
    Target target;
    std::vector<Scene> others;
    std::vector<std::unique_ptr<MappedLight>> lights{}; ///< the chosen one last
    SurfacePrograms surface{};
    VisibleDepths visible;
    KeptClaims claims{};
    Program not_lit{};
    std::vector<LightingPass> lighting{}; ///< one per light, or none

    Frames(Gpu& gpu, const Scene& drawn, const Plan& plan, const MapRecipe& recipe)
        : gl(gpu.gl()), scene(drawn), depth_model(eye_depth_model(drawn)),
          target(make_target(gl, drawn.camera, depth_model.floating)),
          others(recipe.lighting ? under_lights_before(drawn) : std::vector<Scene>{}),
          visible(visible_depths(drawn.camera)) {
        const auto add = [&](const Scene& under) {
            lights.push_back(
                std::make_unique<MappedLight>(gl, under, model_of(recipe, plan, under), recipe));
        };
        for (const Scene& other : others) add(other);
        add(drawn);
        surface = link_surface(gl, clip_transform(drawn, depth_model), lights.back()->geometry);
        claims = make_kept_claims(gl, target, lights.size());
        if (recipe.lighting) {
            add_color(gl, target,
                      recipe.lighting->model.arithmetic != ColorModel::Arithmetic::floating);
            not_lit = link_not_lit(gl);
            for (const auto& light : lights)
                lighting.push_back(make_lighting_pass(
                    gl, light->scene, clip_transform(light->scene, depth_model), *recipe.lighting,
                    Between::nothing, lighting.empty() ? nullptr : &lighting.front()));
        }
        check(gl, "making the passes");
    }
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    /// Draws the claim of a light and, where bumps are lit, the stencil that it makes.
    void draw_shadows(std::size_t light, StageClock& clock) {
        lights[light]->draw_lit(target);
        keep_claim(gl, target, claims, light);
        clock.end("classes");
        if (!lighting.empty()) keep_claim_in_stencil(gl, not_lit, target);
    }

    /// Once more, or of another light, over the same surfaces.
    void draw_shadows_anew(std::size_t light, StageClock& clock) {
        begin_frame(gl, target, lights[light]->geometry, depth_model);
        clear_stencil(gl, target, 0);
        take_unlit(gl, target, claims);
        draw_shadows(light, clock);
    }

    void draw(StageClock& clock) {
        for (const auto& light : lights) draw_map(gl, light->map, light->geometry);
        clock.end("map");
        const Geometry& geometry = lights.front()->geometry;
        begin_frame(gl, target, geometry, depth_model);
        draw_surface(gl, surface, target, geometry, depth_model, visible, 0);
        keep_unlit(gl, target, claims);
        clock.end("surface");
        draw_shadows(0, clock);
        if (lighting.empty()) return;
        draw_lighting(gl, lighting, scene, target, [&](std::size_t light) {
            clock.end("lighting");
            draw_shadows_anew(light, clock);
        });
        gl.BindVertexArray(lights.back()->geometry.vertices.name());
        clock.end("lighting");
    }
};

} // namespace

Frame draw_map_shadows(Gpu& gpu, const Scene& scene, const Plan& plan, const MapRecipe& recipe) {
    const MapModel model = model_of(recipe, plan, scene);
    assert(!recipe.lighting || model.filter == 0);
    Frames frames(gpu, scene, plan, recipe);
    const GlFunctions& gl = gpu.gl();
    const auto draw = [&](StageClock& clock) { frames.draw(clock); };
    compile_all(gl, draw);
    const FrameTime time = // results tell the map's own time
        quickest_frame(gl, gpu.timed_frames(), true, draw);
    Frame frame = read_back(gl, frames.target, Counter::none);
    if (recipe.lighting) {
        frame.color = read_color(gl, frames.target);
        frame.color_model = recipe.lighting->model;
        frame.color_model.bytes = gpu.byte_errors();
    }
    frame.claims_before = read_claims(gl, frames.target, frames.claims);
    frame.family = "map";
    frame.mapped =
        MapEvidence{.model = model,
                    .faces = read_map(gl, frames.lights.back()->map),
                    .format = format_of(gl, frames.lights.back()->map),
                    .offset_unit = model.offset_units != 0 ? measured_offset_unit(gl, model.format)
                                                           : OffsetUnit{},
                    .map_milliseconds = time.stages.front().milliseconds};
    if (model.filter > 0) frame.share = take_shares(model, frame.claim);
    frame.depth_model = frames.depth_model;
    frame.depth_model.subpixel_bits = gpu.driver().subpixel_bits;
    frame.milliseconds = time.milliseconds;
    frame.stages = time.stages;
    end_frame(gl);
    return frame;
}

} // namespace shadowproof
