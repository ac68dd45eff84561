#include "raster/maps/map_shadows.h"

#include "raster/gl/stage_clock.h"

#include <algorithm>
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
    // Locations as map_test.glsl and map_light_spot.frag lay them out.
    gl.ProgramUniform1f(light.name(), 15, static_cast<float>(model.bias));
    gl.ProgramUniform2f(light.name(), 16, static_cast<float>(model.near),
                        static_cast<float>(model.far));
    gl.ProgramUniform1i(light.name(), 17, model.value == MapValue::distance ? 1 : 0);
    gl.ProgramUniform1i(light.name(), 23, model.shape == MapModel::Shape::sun ? 1 : 0);
    if (model.shape == MapModel::Shape::cube) return;
    const Camera camera = map_camera(chosen_light(scene), model, 0);
    const glm::mat3 map_from_world(
        glm::transpose(glm::dmat3(camera.right / camera.tan_half_height,
                                  camera.up / camera.tan_half_height, camera.forward)));
    gl.ProgramUniformMatrix3fv(light.name(), 18, 1, GL_FALSE, glm::value_ptr(map_from_world));
    if (model.filter == 0) return;
    gl.ProgramUniform1i(light.name(), 21, model.filter);
    gl.ProgramUniform1i(light.name(), 22, model.average == MapAverage::values ? 1 : 0);
}

std::string_view light_shader(const MapModel& model) {
    if (model.shape == MapModel::Shape::cube) return "map_light_cube.frag";
    if (model.shape == MapModel::Shape::sun) return "map_light_sun.frag";
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

/// The shares of comparisons that say `lit`, whose number map_light_spot_filtered.frag adds to
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

/// What is drawn with, made once.
struct Frames {
    const GlFunctions& gl;
    DepthModel depth_model;
    Target target;
    Geometry geometry;
    MapPass map;
    Program surface;
    Program light;
    VisibleDepths visible;

    Frames(Gpu& gpu, const Scene& scene, const MapModel& model, MapMaking making)
        : gl(gpu.gl()), depth_model(eye_depth_model(scene)),
          target(make_target(gl, scene.camera, depth_model.floating)),
          geometry(upload(gl, scene, {})), map(make_map_pass(gl, scene, geometry, model, making)),
          visible{static_cast<float>(scene.camera.near), static_cast<float>(scene.camera.far)} {
        surface = link_projection(gl, "surface.frag", clip_transform(scene, depth_model), geometry);
        light = link_light(gl, scene, light_transform(scene, depth_model, model), geometry,
                           Between::nothing, light_shader(model));
        set_test(gl, light, scene, model);
        check(gl, "making the passes");
    }

    void draw(StageClock& clock) {
        draw_map(gl, map, geometry);
        clock.end("map");
        begin_frame(gl, target, geometry, depth_model);
        draw_surface(gl, surface, target, geometry, depth_model, visible, 0);
        clock.end("surface");
        gl.BindTextureUnit(2, map.texture.name());
        draw_light(gl, light, target, geometry, Counter::none);
        gl.BindTextureUnit(2, 0);
        clock.end("classes");
    }
};

} // namespace

Frame draw_map_shadows(Gpu& gpu, const Scene& scene, const Plan& plan, const MapRecipe& recipe) {
    const MapModel model = with_settings(recipe.model, plan.asked.map, scene);
    Frames frames(gpu, scene, model, recipe.making);
    const GlFunctions& gl = gpu.gl();
    const auto draw = [&](StageClock& clock) { frames.draw(clock); };
    compile_all(gl, draw);
    const FrameTime time = quickest_frame(gl, true, draw); // results tell the map's own time
    Frame frame = read_back(gl, frames.target, Counter::none);
    frame.family = "map";
    frame.mapped = MapEvidence{.model = model,
                               .faces = read_map(gl, frames.map),
                               .format = depth_format(gl, frames.map.texture),
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
