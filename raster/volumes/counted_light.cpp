#include "raster/volumes/counted_light.h"

#include "raster/gl/shader.h"
#include "raster/volumes/caster_parts.h"
#include "raster/volumes/eye_count.h"
#include "raster/volumes/near_cap.h"
#include "raster/volumes/near_plane.h"
#include "raster/volumes/split_volume.h"
#include "raster/volumes/volume_measure.h"
#include "scenes/mesh/extrusion.h"
#include "scenes/mesh/split_far_ends.h"
#include "scenes/mesh/touching_light.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

/// Casters that are counted alike, ready to be drawn.
struct CountedLight::Part : CasterPart {
    SplitFarEnds split{};
    std::uint32_t first_split = 0; ///< number of the corner along the first of its directions
    VolumePass volumes{};
};

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
    if (camera.is_orthographic()) {
        if (!clamp) return visible;
        return {.near = recipe.depth_model.reversed() ? 0.0F : -1.0F, .far = 1, .of_clip = true};
    }
    if (clamp) visible.near = static_cast<float>(camera.near);
    if (clamp || !recipe.depth_model.finite()) visible.far = static_cast<float>(camera.far);
    return visible;
}

bool touch_light(const Scene& casters) {
    for (std::uint32_t triangle = 0; triangle < casters.triangles.size(); ++triangle)
        if (touches_light(casters, triangle)) return true;
    return false;
}

Between between_of(const StencilRecipe& recipe) {
    return recipe.making == VolumeMaking::geometry_shader ? Between::geometry_shader
                                                          : Between::nothing;
}

} // namespace

/// Volumes of finite length have corners at their far ends, and no directions that need splitting.
std::vector<std::unique_ptr<CountedLight::Part>>
CountedLight::make_parts(const Scene& scene, const StencilRecipe& recipe) {
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
std::vector<glm::vec3> CountedLight::split_points(const Scene& scene, const StencilRecipe& recipe,
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

CountedLight::CountedLight(const GlFunctions& gl, const Scene& scene, const StencilRecipe& recipe,
                           const Target& target)
    : gl_(gl), scene_(scene), recipe_(recipe), target_(target), parts_(make_parts(scene, recipe)),
      geometry_(upload(gl, scene,
                       std::isfinite(recipe.counting.extrusion)
                           ? extruded_positions(scene, recipe.counting.extrusion)
                           : std::vector<glm::vec3>{},
                       split_points(scene, recipe, parts_))),
      transform_(clip_transform(scene, recipe.depth_model)),
      surface_(link_surface(gl, transform_, geometry_, between_of(recipe))),
      light_(link_light(gl, scene, transform_, geometry_, between_of(recipe))) {
    touches_light_ =
        std::ranges::any_of(parts_, [](const auto& part) { return touch_light(part->scene); });
    for (const auto& part : parts_) part->volumes = make_volumes(*part);
    if (recipe.near_plane == NearPlane::from_light)
        occluders_ = make_occluder_pass(
            gl, parts_.front()->scene, geometry_, parts_.front()->split,
            parts_.front()->first_split +
                static_cast<std::uint32_t>(parts_.front()->split.directions.size()),
            casters_near_light(parts_.front()->scene));
}

CountedLight::~CountedLight() = default;

Between CountedLight::between() const {
    return between_of(recipe_);
}

VolumePass CountedLight::make_volumes(const Part& part) const {
    const auto of_part = [&](const std::vector<std::uint8_t>& flags) {
        std::vector<std::uint8_t> mine;
        if (flags.empty()) return mine;
        for (const std::uint32_t triangle : part.triangles)
            mine.push_back(triangle < flags.size() ? flags[triangle] : 0); // or fills a hole
        return mine;
    };
    SpecialCaps special{.hidden = {}, .flipped = of_part(recipe_.flipped)};
    if (part.caster.test == Counting::Test::depth_pass)
        special.hidden = of_part(recipe_.hidden_caps);
    if (recipe_.near_plane == NearPlane::capped)
        return make_capped_pass(gl_, part.scene, geometry_, transform_, recipe_.depth_model,
                                special, part.split);
    const VolumeCaps caps{part.caster.light_cap, part.caster.dark_cap && !has_caps_at_infinity()};
    // Shaders use the scene's winding, cannot always tell on which side of a triangle that
    // touches the light the light is, and split no far end: such volumes are made on the CPU.
    const VolumeMaking making =
        part.flipped || touches_light_ ? VolumeMaking::on_cpu : recipe_.making;
    return make_volume_pass(
        gl_, part.scene, geometry_, transform_, caps, making, between_of(recipe_),
        with_split_far_ends(with_special_caps(recipe_.extruder(part.scene), special), part.scene,
                            part.split, part.first_split));
}

void CountedLight::update() {
    for (const auto& part : parts_) part->volumes.update();
    if (occluders_) occluders_->update();
    start_ = 0;
    if (recipe_.counting.start == Counting::Start::eye)
        start_ = static_cast<std::int64_t>(volumes_around_eye(parts_.front()->scene));
    if (!has_caps_at_infinity() || recipe_.depth_model.clips_at_far()) return;
    for (const auto& part : parts_)
        if (part->caster.dark_cap)
            start_ += static_cast<std::int64_t>(volumes_at_infinity(part->scene));
}

/// Whether dark caps lie where parallel lines of sight end: all at one point, met by every one of
/// them or by none. They have no area, and are not drawn: the counter starts with them, unless the
/// far plane clips them.
bool CountedLight::has_caps_at_infinity() const {
    return scene_.camera.is_orthographic() && std::isinf(recipe_.counting.extrusion);
}

std::uint8_t CountedLight::stencil_start() const {
    const bool stops = recipe_.counting.operation == Counting::Operation::saturate;
    return static_cast<std::uint8_t>(stops ? std::min<std::int64_t>(start_, 0xff) : start_);
}

void CountedLight::begin() const {
    begin_frame(gl_, target_, geometry_, recipe_.depth_model);
}

void CountedLight::draw_surfaces() const {
    draw_surface(gl_, surface_, target_, geometry_, recipe_.depth_model,
                 visible_depths(scene_.camera, recipe_), stencil_start());
}

void CountedLight::clear_stencil() const {
    shadowproof::clear_stencil(gl_, target_, stencil_start());
}

void CountedLight::count() {
    if (recipe_.counter == Counter::stencil)
        count_in_stencil();
    else
        count_in_sum();
    check(gl_, "the volume pass");
}

void CountedLight::draw_lit() const {
    draw_light(gl_, light_, target_, geometry_, recipe_.counter);
}

void CountedLight::count_in_stencil() {
    begin_counting(gl_, target_, recipe_);
    const Counting::Operation kind = recipe_.counting.operation;
    for (const auto& part : parts_) {
        const Steps steps = steps_of(part->caster.test);
        set_steps(gl_, kind, part->caster.test, steps);
        part->volumes.draw();
        set_steps(gl_, kind, part->caster.test, {.front = steps.back, .back = steps.front});
        part->volumes.draw_flipped();
    }
    if (!occluders_) return;
    gl_.StencilOp(GL_KEEP, GL_KEEP, operation(+1, kind));
    occluders_->draw();
}

/// Blending adds what passes the depth test. Where faces behind the surface are to be counted
/// the test is therefore inverted: it passes what fails the strict one.
void CountedLight::count_in_sum() {
    begin_adding(gl_, target_, static_cast<float>(start_));
    for (const auto& part : parts_) {
        const bool pass = part->caster.test == Counting::Test::depth_pass;
        const GLenum nearer = recipe_.depth_model.reversed() ? GL_GREATER : GL_LESS;
        const GLenum others = recipe_.depth_model.reversed() ? GL_LEQUAL : GL_GEQUAL;
        gl_.DepthFunc(pass ? nearer : others);
        const Steps steps = steps_of(part->caster.test);
        const auto front = static_cast<float>(steps.front);
        const auto back = static_cast<float>(steps.back);
        set_worth(gl_, part->volumes, front, back);
        part->volumes.draw();
        set_worth(gl_, part->volumes, back, front);
        part->volumes.draw_flipped();
    }
    end_adding(gl_);
}

void CountedLight::measure(Frame& frame) {
    std::vector<const VolumePass*> passes;
    for (const auto& part : parts_) passes.push_back(&part->volumes);
    if (occluders_) passes.push_back(&*occluders_);
    measure_volumes(
        gl_, target_, recipe_.depth_model, passes,
        [&] {
            for (const auto& part : parts_) {
                part->volumes.draw();
                part->volumes.draw_flipped();
            }
            if (occluders_) occluders_->draw();
        },
        frame);
}

} // namespace shadowproof
