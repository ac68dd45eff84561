#include "compare/baseline.h"
#include "compare/blank.h"
#include "compare/command/commands.h"
#include "compare/command/console.h"
#include "compare/command/gate_options.h"
#include "compare/command/outcome.h"
#include "compare/command/stopwatch.h"
#include "compare/memory.h"
#include "compare/report_data.h"
#include "raster/render.h"
#include "scenes/catalog.h"
#include "scenes/digest.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <utility>

namespace shadowproof {

namespace {

struct VerifyOptions {
    std::vector<std::string> scenes;
    SceneOptions scene;
    TechniqueOptions technique;
    GateOptions gate;
    OutputOptions output;
};

std::vector<std::string> scenes_to_verify(const VerifyOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    std::vector<std::string> all;
    for (const BundledScene& scene : bundled_scenes()) all.emplace_back(scene.name);
    return all;
}

template <class Names>
std::vector<std::string> cause_names(const Names& causes) {
    std::vector<std::string> names;
    for (const Cause cause : causes) names.emplace_back(name_of(cause));
    return names;
}

/// A technique that is not for such scenes is left out, unless both are named: then it says so.
std::vector<const Technique*> techniques_for(const VerifyOptions& options, const Scene& scene) {
    std::vector<const Technique*> chosen = options.technique.chosen();
    const bool named = !options.scenes.empty() && !options.technique.techniques.empty();
    if (!named) std::erase_if(chosen, [&](const Technique* one) { return !suits(*one, scene); });
    return chosen;
}

/// What all scenes of a run share.
struct Run {
    const VerifyOptions& options;
    const std::optional<ResultsFile>& baseline;
    Gpu& gpu;
    Console& console;
    Report& report;
    ReportFolder& folder;
};

/// A scene under one of its lights, traced: what its techniques are judged against.
struct Trial {
    const Scene& scene;
    const GroundTruth& truth;
    Plan plan;
    Tracer tracer;
    ShadowDepths depths;
    Silhouette silhouette;
};

Cell try_technique(const Run& run, const Trial& trial, const Technique& technique) {
    Cell cell;
    cell.technique = technique.name;
    cell.summary = technique.summary;
    try {
        cell.frame = render(technique, trial.scene, trial.plan, run.gpu);
        cell.milliseconds = cell.frame.milliseconds;
        refuse_blank(technique.name, trial.truth, cell.frame);
        cell.volume_fragments = cell.frame.volume_fragments;
        cell.left_out = cell.frame.left_out;
        cell.saved = cell.frame.saved;
        const Prediction prediction(trial.tracer, trial.silhouette, trial.truth, trial.depths,
                                    cell.frame.counting, cell.frame.depth_model);
        cell.comparison = classify(trial.tracer, trial.silhouette, trial.truth, trial.depths,
                                   cell.frame, prediction);
        cell.verdict = judge(trial.scene, technique.fails_at, technique.by_nature, cell.comparison);
        cell.excused =
            excused_causes(trial.scene, technique.fails_at, technique.by_nature, cell.comparison);
        const Stopwatch stopwatch;
        cell.ledgers =
            list_ledgers(trial.tracer, trial.truth, cell.frame, prediction, cell.comparison.cause);
        run.report.report_milliseconds += stopwatch.milliseconds();
    } catch (const std::bad_alloc&) {
        cell.frame = {};
        cell.comparison = {};
        cell.error = cell.technique + ": " + out_of_memory;
    } catch (const Error& error) {
        cell.error = error.what();
    }
    return cell;
}

ColumnWidths widths_of(const VerifyOptions& options, const std::string& scene) {
    ColumnWidths widths{.technique = 0, .scene = static_cast<int>(scene.size()), .verdict = 0};
    for (const Technique* technique : options.technique.chosen())
        widths.technique = std::max(widths.technique, static_cast<int>(technique->name.size()));
    for (const Verdict verdict :
         {Verdict::agrees, Verdict::fails_as_predicted, Verdict::defect, Verdict::unexplained})
        widths.verdict = std::max(widths.verdict, static_cast<int>(name_of(verdict).size()));
    return widths;
}

void describe(Console& console, const SceneResult& result) {
    // Beside a name that is not the file's own: which of several files this is.
    const bool renamed = std::filesystem::path(result.file).stem() != result.name;
    console.heading(renamed ? fmt::format("{} ({})", result.name, result.file) : result.name);
    console.line(fmt::format("  {} triangles, {}x{}, light {}", grouped(result.triangles),
                             result.width, result.height, result.light.name));
    for (const std::string& note : result.notes) console.line("  note: " + note);
    for (const std::string& clause : result.left_out) console.line("  left out: " + clause);
}

/// Two files may have one stem: the second is "stem-2", in the results and in the report.
std::string unique_name(const Report& report, const SceneResult& result) {
    const auto taken = [&](const std::string& name) {
        SceneResult named;
        named.name = name;
        return std::any_of(report.scenes.begin(), report.scenes.end(),
                           [&](const SceneResult& other) {
                               return &other != &result && folder_of(other) == folder_of(named);
                           });
    };
    std::string name = result.name;
    for (int number = 2; taken(name); ++number) name = fmt::format("{}-{}", result.name, number);
    return name;
}

/// Judges the cell by the gate, and says how it went.
void conclude_cell(const Run& run, const SceneResult& scene, Cell& cell,
                   const ColumnWidths& widths) {
    if (run.baseline) compare_with(*run.baseline, scene, cell);
    const Gate& gate = run.report.gate;
    if (cell.error.empty()) cell.first_failing = first_that_fails(cell, gate);
    run.console.cell(scene, cell, widths, fails(cell, gate));
    if (cell.since) run.console.line("  since the baseline: " + words_of(*cell.since));
    const std::string allowed = cause_counts(pixels_allowed(cell, gate));
    if (cell.error.empty() && !allowed.empty()) run.console.line("  allowed: " + allowed);
}

/// Pictures are on the disk by now; the figures stay.
void drop_pictures(Cell& cell) {
    cell.frame = {};
    cell.ledgers = {};
    cell.comparison.cause = {};
    cell.comparison.ledger_miss = {};
    cell.comparison.predicted = {};
    if (cell.comparison.colors) {
        cell.comparison.colors->error = {};
        cell.comparison.colors->verdict = {};
    }
}
void drop_truth(SceneResult& scene) {
    const TraceStatistics statistics = scene.truth.statistics;
    scene.truth = {};
    scene.color = {};
    scene.truth.statistics = statistics;
}

/// Work for the report, in the time that is said to go to it.
template <class Work>
void add_timed(Report& report, const Work& work) {
    const Stopwatch writing;
    work();
    report.report_milliseconds += writing.milliseconds();
}

/// Plans and traces the chosen light of a scene; the truth lies in the result.
Trial begin_trial(const Run& run, const Scene& scene, SceneResult& result) {
    result.light = chosen_light(scene);
    result.name = scene.name;
    if (result.one_of_many) result.name += "-" + result.light.choice;
    result.name = unique_name(run.report, result);
    // A bundled scene is the same wherever it is installed, and so is its report.
    result.file = (is_bundled(result.argument) ? scene.file.filename() : scene.file).string();
    result.width = scene.camera.width;
    result.height = scene.camera.height;
    result.triangles = scene.triangles.size();
    result.digest = digest_of(scene);
    result.camera = scene.camera;
    result.far = finite_far(scene);
    result.meshes = scene.meshes;
    result.provokes = cause_names(scene.provokes);
    result.notes = scene.notes;
    Plan plan = make_plan(scene);
    plan.lighting = run.options.technique.lighting;
    result.notes.insert(result.notes.end(), plan.faults.begin(), plan.faults.end());
    result.left_out = plan.left_out;
    describe(run.console, result);

    run.console.progress(fmt::format("{}: tracing", result.name));
    Tracer tracer(scene, run.options.scene.threads);
    result.truth = trace(tracer);
    result.bump_lit = is_bump_lit(scene);
    if (result.bump_lit) result.color = shade(tracer, result.truth);
    ShadowDepths depths = count_shadow_depths(tracer, result.truth, result.far);
    Silhouette silhouette(tracer);
    return {scene,
            result.truth,
            std::move(plan),
            std::move(tracer),
            std::move(depths),
            std::move(silhouette)};
}

/// Judges the chosen techniques in turn, each into the report as soon as it is judged.
void judge_techniques(const Run& run, const Trial& trial, SceneResult& result) {
    const VerifyOptions& options = run.options;
    const ColumnWidths widths = widths_of(options, result.name);
    for (const Technique* technique : techniques_for(options, trial.scene)) {
        run.console.progress(fmt::format("{}: {}", result.name, technique->name));
        Cell& cell = result.cells.emplace_back(try_technique(run, trial, *technique));
        conclude_cell(run, result, cell, widths);
        add_timed(run.report, [&] { run.folder.add_cell(result, cell, options.scene.threads); });
        drop_pictures(cell);
    }
    add_timed(run.report, [&] { run.folder.add_scene(result); });
    drop_truth(result);
}

/// What goes wrong in `work` is the scene's own, becomes its result, and ends no run. Around what
/// reads and traces it alone: a report that cannot be written ends the run.
template <class Work>
void attempt(const Run& run, SceneResult& result, const Work& work) {
    try {
        work();
    } catch (const std::bad_alloc&) {
        result.error = result.argument + ": " + out_of_memory;
    } catch (const Error& error) {
        result.error = error.what();
    }
    if (result.error.empty()) return;
    result.name = unique_name(run.report, result);
    complain(result.error);
}

/// A scene of several lights is judged under each of them, unless one was chosen: a result each.
void verify_scene(const Run& run, const std::string& argument) {
    Report& report = run.report;
    const std::size_t first = report.scenes.size();
    std::optional<Scene> scene;
    std::size_t lights = 1;
    for (std::size_t i = 0; i < lights; ++i) {
        SceneResult& result = report.scenes.emplace_back();
        result.argument = argument;
        result.name = std::filesystem::path(argument).stem().string();
        result.file = argument;
        std::optional<Trial> trial;
        attempt(run, result, [&] {
            if (!scene) {
                run.console.progress(fmt::format("{}: reading", result.name));
                SceneRequest request = run.options.scene.request();
                request.every_light = !request.light;
                scene = load_scene(argument, request);
                if (techniques_for(run.options, *scene).empty()) return;
                if (request.every_light) lights = scene->lights.size();
            }
            result.one_of_many = lights > 1;
            if (result.one_of_many) scene->light = i;
            trial.emplace(begin_trial(run, *scene, result));
        });
        if (trial) judge_techniques(run, *trial, result);
    }
    // Of all bundled scenes, one that none of the techniques named is for is none of this run.
    if (scene && techniques_for(run.options, *scene).empty()) return report.scenes.resize(first);
    SceneResult& last = report.scenes.back();
    last.no_longer_provoked = stopped_provoking(report, std::span(report.scenes).subspan(first));
    if (!last.no_longer_provoked.empty())
        run.console.always(last.name + ": " + no_longer_provoked_words(last));
}

/// What stands in results.json before the first scene is tried.
Report begin_report(const VerifyOptions& options, const Gpu& gpu) {
    Report report;
    report.version = SHADOWPROOF_VERSION;
    report.gl = gpu.driver();
    report.embree = embree_version();
    report.arguments = settings(options.scene, options.technique);
    const std::vector<std::string> gate = settings(options.gate);
    report.arguments.insert(report.arguments.end(), gate.begin(), gate.end());
    report.gate = options.gate.gate;
    return report;
}

int verify(const VerifyOptions& options) {
    const Stopwatch stopwatch;
    const std::string started = timestamp_now();
    Console console(options.output.quiet);
    // What cannot be read or written is refused before the work is done, not after.
    std::optional<ResultsFile> baseline;
    if (!options.gate.baseline.empty()) baseline = read_results(options.gate.baseline);
    check_outputs(options.output);
    refuse_too_large(options.scene.size.width, options.scene.size.height, comparison_bytes());
    for (const Allowance& allowance : options.gate.gate.allow)
        if (allowance.cause == Cause::edge)
            console.line("note: --allow edge changes nothing: edge pixels never fail");
    ReportFolder folder(options.output.out);
    Gpu gpu(options.technique.platform);
    Report report = begin_report(options, gpu);
    const Run run{options, baseline, gpu, console, report, folder};
    for (const std::string& argument : scenes_to_verify(options)) verify_scene(run, argument);
    if (baseline)
        report.baseline = Baseline{options.gate.baseline, baseline->json["passed"].get<bool>(),
                                   notes_on(*baseline, report)};
    report.passed = passes(report);
    report.milliseconds = milliseconds_since_start_of_process().value_or(stopwatch.milliseconds());
    folder.finish(report);
    return conclude(console, report, options.output, started);
}

} // namespace

Work add_verify(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("verify", "Every technique against the truth; a report of the pixels");
    const auto options = std::make_shared<VerifyOptions>();
    command
        ->add_option("SCENE", options->scenes,
                     "Bundled names, or paths to .gltf, .glb or .md2 (all bundled scenes)")
        ->check(not_empty());
    add_technique_flags(*command, options->technique);
    add_scene_flags(*command, options->scene);
    add_gate_flags(*command, options->gate);
    add_output_flags(*command, options->output);
    return [options] { return verify(*options); };
}

} // namespace shadowproof
