#include "raster/maps/map_shadows.h"

#include "raster/gl/stage_clock.h"
#include "raster/maps/offset_unit.h"
#include "raster/passes/claim_in_stencil.h"

#include <algorithm>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>

namespace shadowproof {

namespace {

DepthModel eye_depth_model(const Scene& scene) {
    return {.projection = DepthModel::Projection::infinite_reversed,
            .near = scene.camera.near,
            .floating = true,
            .eye_relative = true};
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

/// What is drawn with, made once.
struct Frames {
    const GlFunctions& gl;
    DepthModel depth_model;
    Target target;
    Geometry geometry;
    MapPass map;
    SurfacePrograms surface;
    Program shadow{}; ///< asks the map, where the stencil keeps the answer
    Program light;    ///< asks the map, or the stencil
    bool in_stencil = false;
    VisibleDepths visible;
    const Scene& drawn;
    Program not_lit{};
    std::optional<LightingPass> lighting{};

    Frames(Gpu& gpu, const Scene& scene, const MapModel& model, const MapRecipe& recipe)
        : gl(gpu.gl()), depth_model(eye_depth_model(scene)),
          target(make_target(gl, scene.camera, depth_model.floating)),
          geometry(upload(gl, scene, {})),
          map(make_map_pass(gl, scene, geometry, model, recipe.making)),
          in_stencil(recipe.in_stencil), visible{static_cast<float>(scene.camera.near),
                                                 static_cast<float>(scene.camera.far)},
          drawn(scene) {
        surface = link_surface(gl, clip_transform(scene, depth_model), geometry);
        const auto link_pass = [&](std::string_view shader) {
            return link_light(gl, scene, light_transform(scene, depth_model, model), geometry,
                              Between::nothing, shader);
        };
        light = link_pass(in_stencil ? "light.frag" : light_shader(model));
        if (in_stencil) shadow = link_pass("map_stencil_spot.frag");
        set_test(gl, in_stencil ? shadow : light, scene, model);
        if (recipe.lighting) {
            add_color(gl, target,
                      recipe.lighting->model.arithmetic != ColorModel::Arithmetic::floating);
            not_lit = link_not_lit(gl);
            lighting =
                make_lighting_pass(gl, scene, clip_transform(scene, depth_model), *recipe.lighting);
        }
        check(gl, "making the passes");
    }

    void draw(StageClock& clock) {
        draw_map(gl, map, geometry);
        clock.end("map");
        begin_frame(gl, target, geometry, depth_model);
        draw_surface(gl, surface, target, geometry, depth_model, visible, 0);
        clock.end("surface");
        gl.BindTextureUnit(2, map.texture.name());
        if (in_stencil) draw_into_stencil(gl, shadow, target, geometry);
        draw_light(gl, light, target, geometry, in_stencil ? Counter::stencil : Counter::none);
        gl.BindTextureUnit(2, 0);
        gl.BindTextureUnit(3, 0);
        clock.end("classes");
        if (!lighting) return;
        keep_claim_in_stencil(gl, not_lit, target);
        draw_lighting(gl, *lighting, drawn, target);
        gl.BindVertexArray(geometry.vertices.name());
        clock.end("lighting");
    }
};

} // namespace

Frame draw_map_shadows(Gpu& gpu, const Scene& scene, const Plan& plan, const MapRecipe& recipe) {
    const MapModel model = with_settings(recipe.model, plan.asked.map, scene);
    assert(!recipe.lighting || model.filter == 0);
    Frames frames(gpu, scene, model, recipe);
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
    frame.family = "map";
    frame.mapped =
        MapEvidence{.model = model,
                    .faces = read_map(gl, frames.map),
                    .format = format_of(gl, frames.map),
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
