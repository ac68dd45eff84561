#include "compare/command/verify/worker.h"

#include "compare/blank.h"
#include "compare/command/standard_output.h"
#include "compare/command/stopwatch.h"
#include "compare/command/verify/messages.h"
#include "compare/memory.h"
#include "raster/render.h"
#include "scenes/catalog.h"
#include "scenes/digest.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

namespace shadowproof {

namespace {

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

/// What all scenes of a worker share.
struct Run {
    const WorkerSetup& setup;
    Gpu& gpu;
    std::vector<std::string>& folders; ///< taken so far
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

/// Adds the milliseconds spent on ledgers to `report_milliseconds`.
Cell try_technique(const Run& run, const Trial& trial, const Technique& technique,
                   double& report_milliseconds) {
    Cell cell;
    cell.technique = technique.name;
    cell.summary = technique.summary;
    try {
        cell.frame = render(technique, trial.scene, trial.plan, run.gpu);
        cell.milliseconds = cell.frame.milliseconds;
        cell.volume_fragments = cell.frame.volume_fragments;
        cell.left_out = cell.frame.left_out;
        cell.saved = cell.frame.saved;
        const Prediction prediction(trial.tracer, trial.silhouette, trial.truth, trial.depths,
                                    cell.frame.counting, cell.frame.depth_model);
        cell.comparison = classify(trial.tracer, trial.silhouette, trial.truth, trial.depths,
                                   cell.frame, prediction);
        refuse_blank(technique.name, trial.truth, cell.frame, cell.comparison);
        cell.verdict = judge(trial.scene, technique.fails_at, technique.by_nature, cell.comparison);
        cell.excused =
            excused_causes(trial.scene, technique.fails_at, technique.by_nature, cell.comparison);
        const Stopwatch stopwatch;
        cell.ledgers =
            list_ledgers(trial.tracer, trial.truth, cell.frame, prediction, cell.comparison.cause);
        report_milliseconds += stopwatch.milliseconds();
    } catch (const std::bad_alloc&) {
        cell.frame = {};
        cell.comparison = {};
        cell.error = cell.technique + ": " + out_of_memory;
    } catch (const Error& error) {
        cell.error = error.what();
    }
    return cell;
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
std::string unique_name(const std::vector<std::string>& folders, const std::string& wanted) {
    SceneResult named;
    named.name = wanted;
    for (int number = 2;
         std::find(folders.begin(), folders.end(), folder_of(named)) != folders.end(); ++number)
        named.name = fmt::format("{}-{}", wanted, number);
    return named.name;
}

/// Judges the cell by the gate, and says how it went.
void conclude_cell(const WorkerSetup& setup, const SceneResult& scene, Cell& cell,
                   const ColumnWidths& widths) {
    const Gate& gate = setup.options.gate.gate;
    if (setup.baseline) compare_with(*setup.baseline, scene, cell);
    if (cell.error.empty()) cell.first_failing = first_that_fails(cell, gate);
    setup.console.cell(scene, cell, widths, fails(cell, gate));
    if (cell.since) setup.console.line("  since the baseline: " + words_of(*cell.since));
    const std::string allowed = cause_counts(pixels_allowed(cell, gate));
    if (cell.error.empty() && !allowed.empty()) setup.console.line("  allowed: " + allowed);
}

/// Plans and traces the chosen light of a scene; the truth lies in the result.
Trial begin_trial(const Run& run, const Scene& scene, SceneResult& result, bool begun) {
    const VerifyOptions& options = run.setup.options;
    require_scene(options.scene.memory, scene, Workload::comparison);
    result.light = chosen_light(scene);
    if (!begun) {
        result.name = scene.name;
        if (result.one_of_many) result.name += "-" + result.light.choice;
        result.name = unique_name(run.folders, result.name);
    }
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
    plan.lighting = options.technique.lighting;
    result.notes.insert(result.notes.end(), plan.faults.begin(), plan.faults.end());
    result.left_out = plan.left_out;
    if (!begun) describe(run.setup.console, result);

    run.setup.console.progress(fmt::format("{}: tracing", result.name));
    Tracer tracer(scene, options.scene.threads);
    result.truth = trace(tracer);
    if (const std::optional<std::string> note = note_if_nothing_is_seen(result.truth)) {
        result.notes.push_back(*note);
        if (!begun) run.setup.console.line("  note: " + *note);
    }
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

/// Judges the chosen techniques in turn, and tells of each as soon as it is judged. Those in
/// `tried` were judged before.
void judge_techniques(const Run& run, const Trial& trial, SceneResult& result,
                      const std::vector<Cell>& tried) {
    const VerifyOptions& options = run.setup.options;
    const ColumnWidths widths = widths_of(options.technique, result.name);
    double report_milliseconds = 0;
    const auto add_timed = [&](const auto& work) {
        const Stopwatch writing;
        work();
        report_milliseconds += writing.milliseconds();
    };
    // Where an earlier worker began the scene, it wrote that.
    if (tried.empty()) add_timed([&] { run.setup.folder.add_scene(result); });
    for (const Technique* technique : techniques_for(options, trial.scene)) {
        if (std::any_of(tried.begin(), tried.end(),
                        [&](const Cell& cell) { return cell.technique == technique->name; }))
            continue;
        run.setup.console.progress(fmt::format("{}: {}", result.name, technique->name));
        send(run.setup.pipe,
             messages::CellBegun{std::string(technique->name), std::string(technique->summary)});
        Cell cell = try_technique(run, trial, *technique, report_milliseconds);
        conclude_cell(run.setup, result, cell, widths);
        add_timed([&] { run.setup.folder.add_cell(result, cell, options.scene.threads); });
        send(run.setup.pipe, messages::CellDone{std::move(cell), report_milliseconds});
        report_milliseconds = 0;
    }
    send(run.setup.pipe, messages::SceneDone{});
}

/// What goes wrong in `work` is the scene's own, becomes its result, and ends no run. Around what
/// reads and traces it alone: a report that cannot be written ends the run. Returns whether it went
/// well.
template <class Work>
bool attempt(const Run& run, SceneResult& result, const Work& work) {
    try {
        work();
        return true;
    } catch (const std::bad_alloc&) {
        result.error = result.argument + ": " + out_of_memory;
    } catch (const Error& error) {
        result.error = error.what();
    }
    result.name = unique_name(run.folders, result.name);
    run.folders.push_back(folder_of(result));
    complain(result.error);
    send(run.setup.pipe, messages::SceneFailed{result.name, result.error});
    return false;
}

/// A scene of several lights is judged under each of them, unless one was chosen: a result each.
void try_scene(const Run& run, const std::string& argument, std::size_t light,
               const std::optional<SceneResult>& begun) {
    const WorkerSetup& setup = run.setup;
    std::optional<Scene> scene;
    std::size_t lights = light + 1;
    for (std::size_t i = light; i < lights; ++i) {
        const bool goes_on = begun && i == light;
        SceneResult result;
        result.argument = argument;
        result.name = goes_on ? begun->name : std::filesystem::path(argument).stem().string();
        result.file = argument;
        if (!goes_on) send(setup.pipe, messages::SceneBegun{result});
        std::optional<Trial> trial;
        bool none_suits = false;
        const bool traced = attempt(run, result, [&] {
            if (!scene) {
                setup.console.progress(fmt::format("{}: reading", result.name));
                SceneRequest request = setup.options.scene.request();
                request.every_light = !request.light;
                scene = load_scene(argument, request);
                none_suits = techniques_for(setup.options, *scene).empty();
                if (request.every_light) lights = scene->lights.size();
                send(setup.pipe, messages::SceneRead{lights, none_suits});
                if (none_suits) return;
            }
            result.one_of_many = lights > 1;
            if (result.one_of_many) scene->light = i;
            trial.emplace(begin_trial(run, *scene, result, goes_on));
        });
        // Of all bundled scenes, one that none of the techniques named is for is none of this run.
        if (none_suits) return;
        if (!traced) continue;
        if (!goes_on) run.folders.push_back(folder_of(result));
        send(setup.pipe, messages::SceneTraced{result});
        judge_techniques(run, *trial, result, goes_on ? begun->cells : std::vector<Cell>());
    }
}

} // namespace

std::vector<std::string> scenes_to_verify(const VerifyOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    std::vector<std::string> all;
    for (const BundledScene& scene : bundled_scenes()) all.emplace_back(scene.name);
    return all;
}

ColumnWidths widths_of(const TechniqueOptions& techniques, const std::string& scene) {
    ColumnWidths widths{.technique = 0, .scene = static_cast<int>(scene.size()), .verdict = 0};
    for (const Technique* technique : techniques.chosen())
        widths.technique = std::max(widths.technique, static_cast<int>(technique->name.size()));
    for (const Verdict verdict : {Verdict::agrees, Verdict::fails_as_predicted, Verdict::defect,
                                  Verdict::unexplained, Verdict::timed_out})
        widths.verdict = std::max(widths.verdict, static_cast<int>(name_of(verdict).size()));
    return widths;
}

void try_scenes(const WorkerSetup& setup, StartingPoint from) {
    try {
        Gpu gpu(setup.options.technique.platform);
        send(setup.pipe, messages::Begun{gpu.driver(), embree_version()});
        const Run run{setup, gpu, from.folders};
        const std::vector<std::string> scenes = scenes_to_verify(setup.options);
        for (std::size_t i = from.scene; i < scenes.size(); ++i) {
            const bool first = i == from.scene;
            try_scene(run, scenes[i], first ? from.light : 0, first ? from.begun : std::nullopt);
        }
        setup.console.clear_progress();
        send(setup.pipe, messages::Done{});
    } catch (const std::bad_alloc&) {
        send(setup.pipe, messages::RunFailed{out_of_memory});
    } catch (const std::exception& error) {
        send(setup.pipe, messages::RunFailed{error.what()});
    }
}

} // namespace shadowproof
