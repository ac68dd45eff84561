#include "raster/stencil.h"

#include "raster/near_cap.h"
#include "raster/near_plane.h"
#include "raster/shader.h"
#include "raster/volume.h"
#include "scenes/error.h"
#include "scenes/extrusion.h"
#include "scenes/holes.h"
#include "scenes/plan.h"

#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace shadowproof {

namespace {

GLenum operation(int step, Counting::Operation kind) {
    assert(step >= -1 && step <= 1);
    if (step == 0) return GL_KEEP;
    switch (kind) {
    case Counting::Operation::wrap:
        break;
    case Counting::Operation::saturate:
        return step > 0 ? GL_INCR : GL_DECR;
    case Counting::Operation::invert:
        return GL_INVERT;
    }
    return step > 0 ? GL_INCR_WRAP : GL_DECR_WRAP;
}

/// State for counting. Strict depth tests: a light cap that coincides with the visible surface
/// counts as behind it.
void begin_counting(const GlFunctions& gl, const Target& target, const StencilRecipe& recipe) {
    const bool reversed =
        recipe.depth_model.projection == DepthModel::Projection::infinite_reversed;
    const Counting& counting = recipe.counting;
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(reversed ? GL_GREATER : GL_LESS);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilMask((1U << static_cast<unsigned>(counting.stencil_bits)) - 1);
    gl.StencilFunc(GL_ALWAYS, 0, ~0U);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.light.name());
}

void set_steps(const GlFunctions& gl, const Counting& counting, const StencilSteps& steps) {
    const auto set = [&](GLenum face, int step) {
        const GLenum counted = operation(step, counting.operation);
        if (counting.test == Counting::Test::depth_pass)
            gl.StencilOpSeparate(face, GL_KEEP, GL_KEEP, counted);
        else
            gl.StencilOpSeparate(face, GL_KEEP, counted, GL_KEEP);
    };
    set(GL_FRONT, steps.front);
    set(GL_BACK, steps.back);
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

/// Whether the way from a point to the light (l, w) meets a triangle that faces the light: the
/// point lies behind the triangle, and on the inner side of the three planes through light and
/// edges.
bool shadows(const Scene& scene, std::uint32_t triangle, const glm::dvec4& light,
             const glm::dvec3& point) {
    if (side(scene, triangle, glm::dvec4(point, 1)) >= 0) return false;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 a = corner(scene, triangle, k);
        const glm::dvec3 b = corner(scene, triangle, (k + 1) % 3);
        const glm::dvec3 plane = glm::cross(light.w * a - glm::dvec3(light), b - a);
        if (glm::dot(plane, point - a) > 0) return false;
    }
    return true;
}

/// Volumes around the eye, by asking every triangle that faces the light.
std::size_t volumes_around_eye(const Scene& scene) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    std::size_t count = 0;
    for (const std::uint32_t triangle : triangles_facing_light(scene))
        count += shadows(scene, triangle, light, scene.camera.eye) ? 1U : 0U;
    return count;
}

/// The scene without what casts no shadow, its holes filled where the recipe asks for it.
Scene casters_of(const Scene& scene, const Counting& counting) {
    Scene casters = counting.holes_filled ? with_holes_filled(scene) : scene;
    const std::vector<std::uint8_t> casts = casting_triangles(casters);
    std::size_t kept = 0;
    for (std::size_t triangle = 0; triangle < casts.size(); ++triangle)
        if (casts[triangle] != 0) casters.triangles[kept++] = casters.triangles[triangle];
    casters.triangles.resize(kept);
    casters.meshes.clear(); // they no longer say which triangles are whose
    return casters;
}

/// What the passes of one frame draw with.
struct Frames {
    const GlFunctions& gl;
    const Scene& scene;
    const StencilRecipe& recipe;
    Scene casters;
    Target target;
    Geometry geometry;
    ClipTransform transform;
    Program surface;
    Program light;
    VolumePass volumes;
    std::optional<VolumePass> occluders;
    std::uint8_t start = 0;

    Frames(Gpu& gpu, const Scene& drawn, const StencilRecipe& with)
        : gl(gpu.gl()), scene(drawn), recipe(with), casters(casters_of(drawn, with.counting)),
          target(make_target(gl, drawn.camera, with.depth_model.floating)),
          geometry(upload(gl, drawn,
                          std::isfinite(with.counting.extrusion)
                              ? extruded_positions(drawn, with.counting.extrusion)
                              : std::vector<glm::vec3>{})),
          transform(clip_transform(drawn, with.depth_model)),
          surface(link_projection(gl, "surface.frag", transform, geometry, between(with))),
          light(link_light(gl, drawn, transform, geometry, between(with))),
          volumes(with.near_plane == NearPlane::capped
                      ? make_capped_pass(gl, casters, geometry, transform, with.depth_model)
                      : make_volume_pass(gl, casters, geometry, transform, with.counting,
                                         with.making, with.extruder(casters))) {
        if (with.near_plane == NearPlane::from_light)
            occluders = make_occluder_pass(gl, casters, geometry);
        check(gl, "making the passes");
    }
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    static Between between(const StencilRecipe& recipe) {
        return recipe.making == VolumeMaking::geometry_shader ? Between::geometry_shader
                                                              : Between::nothing;
    }

    void update() {
        volumes.update();
        if (occluders) occluders->update();
        start = 0;
        if (recipe.counting.start == Counting::Start::eye)
            start = static_cast<std::uint8_t>(volumes_around_eye(casters));
    }

    void draw() {
        begin_frame(gl, target, geometry, recipe.depth_model, recipe.counting.depth_clamp);
        gl.DepthRange(recipe.near_plane == NearPlane::capped ? ledge : 0, 1);
        draw_surface(gl, surface, target, geometry, recipe.depth_model,
                     visible_depths(scene.camera, recipe), start);
        begin_counting(gl, target, recipe);
        const StencilSteps& steps = recipe.steps;
        set_steps(gl, recipe.counting, steps);
        volumes.draw();
        set_steps(gl, recipe.counting, {.front = steps.back, .back = steps.front});
        volumes.draw_turned();
        if (occluders) {
            gl.StencilOp(GL_KEEP, GL_KEEP, operation(+1, recipe.counting.operation));
            occluders->draw();
        }
        check(gl, "the volume pass");
        draw_light(gl, light, target, geometry);
    }
};

} // namespace

Frame draw_stencil_shadows(Gpu& gpu, const Scene& scene, const StencilRecipe& recipe) {
    Frames frames(gpu, scene, recipe);
    const GlFunctions& gl = gpu.gl();
    std::chrono::steady_clock::duration elapsed{};
    for (int run = 0; run < 2; ++run) {
        const auto start = std::chrono::steady_clock::now();
        frames.update();
        frames.draw();
        gl.Finish();
        elapsed = std::chrono::steady_clock::now() - start;
    }
    end_frame(gl);

    Frame frame = read_back(gl, frames.target);
    frame.counting = recipe.counting;
    frame.depth_model = recipe.depth_model;
    frame.depth_model.subpixel_bits = gpu.driver().subpixel_bits;
    frame.milliseconds = std::chrono::duration<double, std::milli>(elapsed).count();
    return frame;
}

StencilRecipe zpass_recipe(const Scene& scene) {
    return {.counting = {.test = Counting::Test::depth_pass, .dark_cap = false},
            .steps = {.front = +1, .back = -1},
            .depth_model = {.projection = DepthModel::Projection::finite,
                            .near = scene.camera.near,
                            .far = finite_far(scene)}};
}

StencilRecipe zfail_reversed_recipe(const Scene& scene) {
    return {.counting = {.test = Counting::Test::depth_fail},
            .steps = {.front = -1, .back = +1},
            .depth_model = {.projection = DepthModel::Projection::infinite_reversed,
                            .near = scene.camera.near,
                            .floating = true,
                            .eye_relative = true}};
}

} // namespace shadowproof
