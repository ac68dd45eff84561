#include "raster/stencil.h"

#include "raster/passes.h"
#include "raster/shader.h"
#include "scenes/error.h"

#include <array>
#include <cassert>
#include <chrono>

namespace shadowproof {

namespace {

struct Programs {
    Program surface;
    Program volume;
    Program light;
};

Programs make_programs(const GlFunctions& gl, const ClipTransform& transform,
                       const Geometry& geometry) {
    Programs programs{.surface = link_files(gl, "project.vert", "surface.frag"),
                      .volume = link_files(gl, "project.vert", "volume.frag"),
                      .light = link_files(gl, "project.vert", "light.frag")};
    for (const Program* program : {&programs.surface, &programs.volume, &programs.light})
        set_transform(gl, *program, transform, geometry);
    check(gl, "making the shaders");
    return programs;
}

Triangles upload_volume(const GlFunctions& gl, const ShadowVolume& volume,
                        const Counting& counting) {
    std::vector<std::span<const glm::uvec3>> parts{volume.sides};
    if (counting.light_cap) parts.emplace_back(volume.light_cap);
    if (counting.dark_cap) parts.emplace_back(volume.dark_cap);
    return upload_triangles(gl, parts);
}

GLenum operation(int step) {
    assert(step >= -1 && step <= 1);
    return step == 0 ? GL_KEEP : step > 0 ? GL_INCR_WRAP : GL_DECR_WRAP;
}

/// Counts the faces of the volume. Strict depth tests: a light cap that coincides with the visible
/// surface counts as behind it.
void draw_volume(const GlFunctions& gl, const Program& program, const Target& target,
                 const Geometry& geometry, const Triangles& volume, const StencilRecipe& recipe) {
    const bool reversed =
        recipe.depth_model.projection == DepthModel::Projection::infinite_reversed;
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(reversed ? GL_GREATER : GL_LESS);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilMask((1U << static_cast<unsigned>(recipe.counting.stencil_bits)) - 1);
    gl.StencilFunc(GL_ALWAYS, 0, ~0U);
    const GLenum front = operation(recipe.steps.front);
    const GLenum back = operation(recipe.steps.back);
    if (recipe.counting.test == Counting::Test::depth_pass) {
        gl.StencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, front);
        gl.StencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, back);
    } else {
        gl.StencilOpSeparate(GL_FRONT, GL_KEEP, front, GL_KEEP);
        gl.StencilOpSeparate(GL_BACK, GL_KEEP, back, GL_KEEP);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.light.name());
    gl.UseProgram(program.name());
    draw_triangles(gl, geometry, volume, 0, volume.count);
    check(gl, "the volume pass");
}

/// The projection clips at the near plane, and a finite one at the far plane; depth clamping undoes
/// both, and must then do so for surfaces too, or their caps would be clipped otherwise than they.
VisibleDepths visible_depths(const Camera& camera, const StencilRecipe& recipe) {
    VisibleDepths visible;
    const bool clamp = recipe.counting.depth_clamp;
    if (clamp) visible.near = static_cast<float>(camera.near);
    if (clamp || recipe.depth_model.projection != DepthModel::Projection::finite)
        visible.far = static_cast<float>(camera.far);
    return visible;
}

} // namespace

Frame draw_stencil_shadows(Gpu& gpu, const Scene& scene, const ShadowVolume& volume,
                           const StencilRecipe& recipe) {
    const GlFunctions& gl = gpu.gl();
    const DepthModel& depth_model = recipe.depth_model;
    const Target target = make_target(gl, scene.camera, depth_model.floating);
    const Geometry geometry = upload(gl, scene);
    const Triangles faces = upload_volume(gl, volume, recipe.counting);
    const Programs programs = make_programs(gl, clip_transform(scene, depth_model), geometry);
    const VisibleDepths visible = visible_depths(scene.camera, recipe);

    std::chrono::steady_clock::duration elapsed{};
    for (int run = 0; run < 2; ++run) {
        const auto start = std::chrono::steady_clock::now();
        begin_frame(gl, target, geometry, depth_model, recipe.counting.depth_clamp);
        draw_surface(gl, programs.surface, target, geometry, depth_model, visible);
        draw_volume(gl, programs.volume, target, geometry, faces, recipe);
        draw_light(gl, programs.light, target, geometry);
        gl.Finish();
        elapsed = std::chrono::steady_clock::now() - start;
    }
    end_frame(gl);

    Frame frame = read_back(gl, target);
    frame.counting = recipe.counting;
    frame.depth_model = depth_model;
    frame.depth_model.subpixel_bits = gpu.driver().subpixel_bits;
    frame.milliseconds = std::chrono::duration<double, std::milli>(elapsed).count();
    return frame;
}

} // namespace shadowproof
