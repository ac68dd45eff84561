#include "raster/volumes/stencil.h"

#include "raster/gl/shader.h"
#include "raster/gl/stage_clock.h"
#include "raster/volumes/caster_parts.h"
#include "raster/volumes/eye_count.h"
#include "raster/volumes/near_cap.h"
#include "raster/volumes/near_plane.h"
#include "raster/volumes/split_volume.h"
#include "raster/volumes/volume_measure.h"
#include "scenes/mesh/extrusion.h"
#include "scenes/mesh/split_far_ends.h"
#include "scenes/mesh/touching_light.h"
#include "scenes/plan/plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

namespace shadowproof {

namespace {

/// What a face of a volume adds to the counter where it is counted: +1 or -1.
struct Steps {
    int front = 0;
    int back = 0;
};

/// In front of the surface, entering a volume adds one; behind it, leaving one does.
Steps steps_of(Counting::Test test) {
    return test == Counting::Test::depth_pass ? Steps{+1, -1} : Steps{-1, +1};
}

GLenum operation(int step, Counting::Operation kind) {
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

/// State for counting in the stencil buffer. Strict depth tests: a light cap that coincides with
/// the visible surface counts as behind it.
void begin_counting(const GlFunctions& gl, const Target& target, const StencilRecipe& recipe) {
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(recipe.depth_model.reversed() ? GL_GREATER : GL_LESS);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilMask((1U << static_cast<unsigned>(recipe.counting.bits)) - 1);
    gl.StencilFunc(GL_ALWAYS, 0, ~0U);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.light.name());
}

void set_steps(const GlFunctions& gl, Counting::Operation kind, Counting::Test test,
               const Steps& steps) {
    const auto set = [&](GLenum face, int step) {
        const GLenum counted = operation(step, kind);
        if (test == Counting::Test::depth_pass)
            gl.StencilOpSeparate(face, GL_KEEP, GL_KEEP, counted);
        else
            gl.StencilOpSeparate(face, GL_KEEP, counted, GL_KEEP);
    };
    set(GL_FRONT, steps.front);
    set(GL_BACK, steps.back);
}

/// The projection clips at the near plane, and a finite one at the far plane. Depth clamping
/// disables both, and must then do so for surfaces too: otherwise they and their caps would be
/// clipped differently.
VisibleDepths visible_depths(const Camera& camera, const StencilRecipe& recipe) {
    VisibleDepths visible;
    const bool clamp = recipe.depth_model.clamp;
    if (clamp) visible.near = static_cast<float>(camera.near);
    if (clamp || !recipe.depth_model.finite()) visible.far = static_cast<float>(camera.far);
    return visible;
}

/// Casters that are counted alike, ready to be drawn.
struct Part : CasterPart {
    SplitFarEnds split{};
    std::uint32_t first_split = 0; ///< number of the corner along the first of its directions
    VolumePass volumes{};
};

bool touch_light(const Scene& casters) {
    for (std::uint32_t triangle = 0; triangle < casters.triangles.size(); ++triangle)
        if (touches_light(casters, triangle)) return true;
    return false;
}

/// Volumes of finite length have corners at their far ends, and no directions that need splitting.
std::vector<std::unique_ptr<Part>> make_parts(const Scene& scene, const StencilRecipe& recipe) {
    std::vector<std::unique_ptr<Part>> parts;
    for (CasterPart& casters : caster_parts(scene, recipe.counting, recipe.flipped,
                                            recipe.making != VolumeMaking::on_cpu)) {
        parts.push_back(std::make_unique<Part>(Part{std::move(casters)}));
        if (!std::isfinite(recipe.counting.extrusion))
            parts.back()->split = split_far_ends(parts.back()->scene);
    }
    return parts;
}

/// The points of the split far ends of all parts, which follow the scene's; sets their numbers.
std::vector<glm::vec3> split_points(const Scene& scene, const StencilRecipe& recipe,
                                    std::vector<std::unique_ptr<Part>>& parts) {
    std::vector<glm::vec3> points;
    for (const auto& part : parts) {
        part->first_split = static_cast<std::uint32_t>(2 * scene.positions.size() + points.size());
        const auto append = [&](const std::vector<glm::vec3>& own) {
            points.insert(points.end(), own.begin(), own.end());
        };
        append(points_towards_infinity(scene, part->split));
        if (recipe.near_plane == NearPlane::from_light)
            append(occluder_points(part->scene, part->split));
    }
    return points;
}

/// What the passes of one frame draw with.
struct Frames {
    const GlFunctions& gl;
    const Scene& scene;
    const StencilRecipe& recipe;
    std::vector<std::unique_ptr<Part>> parts; // their passes refer to them
    Target target;
    Geometry geometry;
    ClipTransform transform;
    SurfacePrograms surface;
    Program light;
    std::optional<VolumePass> occluders;
    std::optional<LightingPass> lighting;
    std::uint8_t start = 0;
    bool touches_light = false; ///< some caster does

    Frames(Gpu& gpu, const Scene& drawn, const StencilRecipe& with)
        : gl(gpu.gl()), scene(drawn), recipe(with), parts(make_parts(drawn, with)),
          target(make_target(gl, drawn.camera, with.depth_model.floating)),
          geometry(upload(gl, drawn,
                          std::isfinite(with.counting.extrusion)
                              ? extruded_positions(drawn, with.counting.extrusion)
                              : std::vector<glm::vec3>{},
                          split_points(drawn, with, parts))),
          transform(clip_transform(drawn, with.depth_model)),
          surface(link_surface(gl, transform, geometry, between(with))),
          light(link_light(gl, drawn, transform, geometry, between(with))) {
        add_sum(gl, target);
        touches_light =
            std::ranges::any_of(parts, [](const auto& part) { return touch_light(part->scene); });
        for (const auto& part : parts) part->volumes = make_volumes(*part);
        if (with.near_plane == NearPlane::from_light)
            occluders = make_occluder_pass(
                gl, parts.front()->scene, geometry, parts.front()->split,
                parts.front()->first_split +
                    static_cast<std::uint32_t>(parts.front()->split.directions.size()),
                casters_near_light(parts.front()->scene));
        if (with.lighting) {
            add_color(gl, target,
                      with.lighting->model.arithmetic != ColorModel::Arithmetic::floating);
            lighting = make_lighting_pass(gl, drawn, transform, *with.lighting);
        }
        check(gl, "making the passes");
    }
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    static Between between(const StencilRecipe& recipe) {
        return recipe.making == VolumeMaking::geometry_shader ? Between::geometry_shader
                                                              : Between::nothing;
    }

    VolumePass make_volumes(const Part& part) const {
        const auto of_part = [&](const std::vector<std::uint8_t>& flags) {
            std::vector<std::uint8_t> mine;
            if (flags.empty()) return mine;
            for (const std::uint32_t triangle : part.triangles)
                mine.push_back(triangle < flags.size() ? flags[triangle] : 0); // or fills a hole
            return mine;
        };
        SpecialCaps special{.hidden = {}, .flipped = of_part(recipe.flipped)};
        if (part.caster.test == Counting::Test::depth_pass)
            special.hidden = of_part(recipe.hidden_caps);
        if (recipe.near_plane == NearPlane::capped)
            return make_capped_pass(gl, part.scene, geometry, transform, recipe.depth_model,
                                    special, part.split);
        const VolumeCaps caps{part.caster.light_cap, part.caster.dark_cap};
        // Shaders use the scene's winding, cannot always tell on which side of a triangle that
        // touches the light the light is, and split no far end: such volumes are made on the CPU.
        const VolumeMaking making =
            part.flipped || touches_light ? VolumeMaking::on_cpu : recipe.making;
        return make_volume_pass(
            gl, part.scene, geometry, transform, caps, making, between(recipe),
            with_split_far_ends(with_special_caps(recipe.extruder(part.scene), special), part.scene,
                                part.split, part.first_split));
    }

    void update() {
        for (const auto& part : parts) part->volumes.update();
        if (occluders) occluders->update();
        start = 0;
        if (recipe.counting.start == Counting::Start::eye)
            start = static_cast<std::uint8_t>(volumes_around_eye(parts.front()->scene));
    }

    void count_in_stencil() {
        begin_counting(gl, target, recipe);
        const Counting::Operation kind = recipe.counting.operation;
        for (const auto& part : parts) {
            const Steps steps = steps_of(part->caster.test);
            set_steps(gl, kind, part->caster.test, steps);
            part->volumes.draw();
            set_steps(gl, kind, part->caster.test, {.front = steps.back, .back = steps.front});
            part->volumes.draw_flipped();
        }
        if (!occluders) return;
        gl.StencilOp(GL_KEEP, GL_KEEP, operation(+1, kind));
        occluders->draw();
    }

    /// Blending adds what passes the depth test. Where faces behind the surface are to be counted
    /// the test is therefore inverted: it passes what fails the strict one.
    void count_in_sum() {
        begin_adding(gl, target);
        for (const auto& part : parts) {
            const bool pass = part->caster.test == Counting::Test::depth_pass;
            const GLenum nearer = recipe.depth_model.reversed() ? GL_GREATER : GL_LESS;
            const GLenum others = recipe.depth_model.reversed() ? GL_LEQUAL : GL_GEQUAL;
            gl.DepthFunc(pass ? nearer : others);
            const Steps steps = steps_of(part->caster.test);
            const auto front = static_cast<float>(steps.front);
            const auto back = static_cast<float>(steps.back);
            set_worth(gl, part->volumes, front, back);
            part->volumes.draw();
            set_worth(gl, part->volumes, back, front);
            part->volumes.draw_flipped();
        }
        end_adding(gl);
    }

    void draw(StageClock& clock) {
        update();
        clock.end("volumes");
        begin_frame(gl, target, geometry, recipe.depth_model);
        gl.DepthRange(recipe.depth_model.front, 1);
        draw_surface(gl, surface, target, geometry, recipe.depth_model,
                     visible_depths(scene.camera, recipe), start);
        clock.end("surface");
        if (recipe.counter == Counter::stencil)
            count_in_stencil();
        else
            count_in_sum();
        check(gl, "the volume pass");
        clock.end("counting");
        draw_light(gl, light, target, geometry, recipe.counter);
        clock.end("classes");
        if (!lighting) return;
        draw_lighting(gl, *lighting, scene, target);
        gl.BindVertexArray(geometry.vertices.name());
        clock.end("lighting");
    }

    void measure(Frame& frame) {
        std::vector<const VolumePass*> passes;
        for (const auto& part : parts) passes.push_back(&part->volumes);
        if (occluders) passes.push_back(&*occluders);
        measure_volumes(
            gl, target, recipe.depth_model, passes,
            [&] {
                for (const auto& part : parts) {
                    part->volumes.draw();
                    part->volumes.draw_flipped();
                }
                if (occluders) occluders->draw();
            },
            frame);
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

Frame draw_stencil_shadows(Gpu& gpu, const Scene& scene, const StencilRecipe& recipe) {
    assert(recipe.counting.casters.empty() ||
           (recipe.near_plane == NearPlane::lost &&
            recipe.counting.start == Counting::Start::zero)); // which take all casters as one part
    assert(recipe.counter == Counter::stencil ||
           (recipe.counting.operation == Counting::Operation::wrap &&
            recipe.counting.start == Counting::Start::zero && recipe.counting.bits == 24));
    assert(!recipe.lighting || recipe.counter == Counter::stencil);
    Frames frames(gpu, scene, recipe);
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
    frame.family = "stencil";
    frame.counted->counting = recipe.counting;
    frame.counted->volume_faces = faces_of(recipe);
    frame.depth_model = recipe.depth_model;
    frame.depth_model.subpixel_bits = gpu.driver().subpixel_bits;
    frame.milliseconds = time.milliseconds;
    frame.stages = time.stages;
    frames.measure(frame);
    end_frame(gl);
    return frame;
}

DepthModel finite_depths(const Scene& scene) noexcept {
    return {.projection = DepthModel::Projection::finite,
            .near = scene.camera.near,
            .far = finite_far(scene)};
}

DepthModel infinite_depths(const Scene& scene) noexcept {
    return {.projection = DepthModel::Projection::infinite, .near = scene.camera.near};
}

DepthModel reversed_depths(const Scene& scene) noexcept {
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
