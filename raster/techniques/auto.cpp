#include "raster/render.h"
#include "raster/technique.h"
#include "raster/volumes/stencil.h"
#include "scenes/mesh/topology.h"
#include "scenes/plan/caster_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>

namespace shadowproof {

namespace {

/// How a caster is counted under its plan. Counting in front of the surface needs no dark cap;
/// counting behind it always needs the light cap.
Counting::Caster counted_as(const CasterPlan& plan) {
    if (!plan.left_out.empty()) return {.left_out = true};
    if (plan.meets_near) return {.dark_cap = plan.reaches_infinity};
    return {.test = Counting::Test::depth_pass, .dark_cap = false};
}

std::vector<Counting::Caster> counted_as(const Scene& scene, const std::vector<CasterPlan>& plans) {
    std::vector<Counting::Caster> casters(scene.triangles.size());
    for (const CasterPlan& plan : plans) {
        const Mesh& mesh = scene.meshes[plan.mesh];
        std::fill_n(casters.begin() + mesh.first_triangle, mesh.triangle_count, counted_as(plan));
    }
    return casters;
}

bool is_counted_behind(const CasterPlan& plan) {
    return plan.left_out.empty() && plan.meets_near;
}

/// "casters 'floor', 'wall' and 3 more"
std::string caster_words(const Scene& scene, const std::vector<const CasterPlan*>& plans) {
    constexpr std::size_t most = 3;
    std::vector<std::string> names;
    for (const CasterPlan* plan : plans)
        if (names.size() < most)
            names.push_back(fmt::format("'{}'", scene.meshes[plan->mesh].name));
    std::string words =
        fmt::format("{} {}", plans.size() == 1 ? "caster" : "casters", fmt::join(names, ", "));
    if (plans.size() > most) words += fmt::format(" and {} more", plans.size() - most);
    return words;
}

/// Whether a caster that is counted in front of the surface does without some of its light cap.
bool hides_caps(const Scene& scene, const CasterPlan& plan,
                const std::vector<std::uint8_t>& hidden_caps) {
    const std::vector<std::uint32_t> triangles = triangles_of(scene.meshes[plan.mesh]);
    return plan.left_out.empty() && !plan.meets_near &&
           std::any_of(triangles.begin(), triangles.end(),
                       [&](std::uint32_t triangle) { return hidden_caps[triangle] != 0; });
}

/// What the scene does not need, a clause a reason: the casters of which it holds.
std::vector<std::string> left_out(const Scene& scene, const std::vector<CasterPlan>& plans,
                                  const std::vector<std::uint8_t>& hidden_caps) {
    std::vector<std::string> reasons;
    for (const CasterPlan& plan : plans)
        if (!plan.left_out.empty() &&
            std::find(reasons.begin(), reasons.end(), plan.left_out) == reasons.end())
            reasons.push_back(plan.left_out);
    std::vector<std::string> clauses;
    const auto add = [&](const std::string& what, const std::string& why, const auto& holds) {
        std::vector<const CasterPlan*> those;
        for (const CasterPlan& plan : plans)
            if (holds(plan)) those.push_back(&plan);
        if (!those.empty())
            clauses.push_back(fmt::format("{}{}: {}", what, caster_words(scene, those), why));
    };
    for (const std::string& reason : reasons)
        add("volumes of ", reason, [&](const CasterPlan& plan) { return plan.left_out == reason; });
    add("dark caps and counting behind the surface for ", "no volume meets the near plane",
        [](const CasterPlan& plan) { return plan.left_out.empty() && !plan.meets_near; });
    add("light caps of ", "each lies in its own surface, and is never in front of what is seen",
        [&](const CasterPlan& plan) { return hides_caps(scene, plan, hidden_caps); });
    add("dark caps of ", "the volume is not seen to infinity", [](const CasterPlan& plan) {
        return plan.left_out.empty() && plan.meets_near && !plan.reaches_infinity;
    });
    clauses.emplace_back("finding the edges that triangles share, frame by frame: a half-edge mesh "
                         "is made once");
    if (std::none_of(plans.begin(), plans.end(), is_counted_behind))
        clauses.emplace_back("depth clamp: nothing behind the surface is counted");
    else if (!scene.camera.is_orthographic())
        clauses.emplace_back("depth clamp: the projection has no far plane");
    return clauses;
}

/// zfail_reversed without what this scene does not need of it: caster by caster, its volume, a cap,
/// or the search behind the surface.
StencilRecipe recipe_by(const Scene& scene, const Plan& plan,
                        const std::vector<CasterPlan>& plans) {
    StencilRecipe made = zfail_reversed_recipe(scene, plan);
    made.extruder = by_half_edges;
    made.sides = VolumeFaces::Sides::half_edges;
    made.counting.dark_cap = true;
    made.counting.casters = counted_as(scene, plans);
    if (!plan.to_infinity && std::none_of(plans.begin(), plans.end(), is_counted_behind)) {
        // Faces past the far plane are not counted.
        made.counting.test = Counting::Test::depth_pass;
        made.depth_model.projection = DepthModel::Projection::finite_reversed;
        made.depth_model.far = finite_far(scene);
        made.depth_model.clamp = false;
    }
    made.hidden_caps = certain_surfaces(scene, made.depth_model.clips_at_far());
    return made;
}

StencilRecipe recipe(const Scene& scene, const Plan& plan) {
    return recipe_by(scene, plan, plan_casters(scene));
}

/// Plans once more, to tell how long that takes, and draws the scene without a plan.
void remark(Gpu& gpu, const Technique& technique, const Scene& scene, const Plan& plan,
            Frame& frame) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const std::vector<CasterPlan> plans = plan_casters(scene);
    const StencilRecipe planned = recipe_by(scene, plan, plans);
    const Clock::duration planning = Clock::now() - start;
    frame.left_out = left_out(scene, plans, planned.hidden_caps);

    const Technique* whole = find_technique("zfail_reversed");
    assert(whole != nullptr);
    Technique lit = *whole;
    lit.lighting = technique.lighting;
    const Frame spent = draw_with(gpu, lit, scene, plan);
    frame.counted->saved = {
        .against = std::string(whole->name),
        .milliseconds = spent.milliseconds - frame.milliseconds,
        .volume_fragments = static_cast<std::int64_t>(spent.counted->volume_fragments) -
                            static_cast<std::int64_t>(frame.counted->volume_fragments),
        .plan_milliseconds = std::chrono::duration<double, std::milli>(planning).count()};
}

} // namespace

Technique auto_technique() {
    return {.name = "auto",
            .summary = "zfail_reversed without what the scene does not need, caster by caster",
            .source = "McGuire, Hughes, Egan, Kilgard & Everitt 2003",
            .needs = "closed volumes, glClipControl, a D32F depth buffer, and a plan of the scene",
            .cost = 0.81,
            .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha},
            .depth_model = reversed_depths,
            .sees_in_parallel = true,
            .recipe = recipe,
            .remark = remark};
}

} // namespace shadowproof
