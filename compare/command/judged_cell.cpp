#include "compare/command/judged_cell.h"

#include "compare/blank.h"
#include "compare/command/process/stopwatch.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "raster/render.h"

namespace shadowproof {

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
    const std::vector<Cause> fails_at = known_on(scene, cell.frame, technique.fails_at);
    const std::vector<Cause> by_nature = known_on(scene, cell.frame, technique.by_nature);
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
