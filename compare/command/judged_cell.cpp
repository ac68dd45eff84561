#include "compare/command/judged_cell.h"

#include "compare/blank.h"
#include "compare/command/process/stopwatch.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "raster/render.h"

#include <algorithm>

namespace shadowproof {

namespace {

/// Whether colours are off by nature: vectors that are not the truth's, which the user's settings
/// may ask of any technique that lights bumps; or heights in units of space, of which tangent space
/// knows no stretched texels, nor a normal map.
bool shades_otherwise(const Scene& scene, const Frame& frame) {
    if (frame.color.pixels.empty()) return false;
    const ColorModel& model = frame.color_model;
    const bool knows_lengths =
        model.axes == ColorModel::Axes::eye && model.bump_form == BumpForm::as_given;
    const bool has_lengths = std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
        return scene.materials[mesh.material].height_in_space;
    });
    return !makes_vectors_as_truth(model) || (has_lengths && !knows_lengths);
}

/// Known causes, and the one that such a scene or such settings add.
std::vector<Cause> with_shading(std::vector<Cause> causes, bool shades_otherwise) {
    if (shades_otherwise && std::ranges::find(causes, Cause::shading) == causes.end())
        causes.push_back(Cause::shading);
    return causes;
}

} // namespace

JudgedCell judged_cell(const Technique& technique, const TracedScene& traced, const Plan& plan,
                       Gpu& gpu, const Wanted& wanted) {
    JudgedCell judged;
    Cell& cell = judged.cell;
    const Scene& scene = traced.scene();
    cell.technique = technique.name;
    cell.summary = technique.summary;
    cell.frame = render(technique, scene, plan, gpu);
    cell.family = cell.frame.family;
    cell.milliseconds = cell.frame.milliseconds;
    cell.left_out = cell.frame.left_out;
    const std::unique_ptr<Judge> family = judge_of(traced, cell.frame);
    cell.comparison = classify(traced, cell.frame, *family);
    refuse_blank(technique.name, traced.truth(), cell.frame,
                 pixels_of(cell.comparison, Cause::unexplained) > 0);
    const bool otherwise = shades_otherwise(scene, cell.frame);
    const std::vector<Cause> fails_at = with_shading(technique.fails_at, otherwise);
    const std::vector<Cause> by_nature = with_shading(technique.by_nature, otherwise);
    cell.verdict = judge(scene, fails_at, by_nature, cell.comparison);
    cell.excused = excused_causes(scene, fails_at, by_nature, cell.comparison);
    if (wanted.strain) judged.strain = family->strain();
    if (!wanted.evidence) return judged;
    const Stopwatch stopwatch;
    cell.evidence = family->report(cell.comparison.cause,
                                   left_beside(scene, Workload::comparison, wanted.memory));
    judged.evidence_milliseconds = stopwatch.milliseconds();
    return judged;
}

} // namespace shadowproof
