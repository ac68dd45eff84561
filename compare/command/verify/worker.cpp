#include "compare/command/verify/worker.h"

#include "compare/blank.h"
#include "compare/command/judged_cell.h"
#include "compare/command/scene_result.h"
#include "compare/command/standard_output.h"
#include "compare/command/stopwatch.h"
#include "compare/command/verify/messages.h"
#include "compare/memory.h"
#include "reference/witness/agreement.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

namespace shadowproof {

namespace {

/// A technique that is not for such scenes is left out, unless both are named: then it says so.
std::vector<const Technique*> techniques_for(const VerifyOptions& options, const Scene& scene) {
    std::vector<const Technique*> chosen = options.technique.chosen();
    const bool named = !options.scenes.empty() && !options.technique.techniques.empty();
    if (!named) std::erase_if(chosen, [&](const Technique* one) { return !suits(*one, scene); });
    return chosen;
}

/// State that all scenes of a worker share.
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
    TracedScene traced;

    Trial(const Scene& scene_given, const GroundTruth& truth_given, Plan plan_given,
          Tracer tracer_given)
        : scene(scene_given), truth(truth_given), plan(std::move(plan_given)),
          tracer(std::move(tracer_given)), traced(tracer, truth) {}
    Trial(const Trial&) = delete; // what is traced refers to the tracer
    Trial& operator=(const Trial&) = delete;
};

/// Adds the milliseconds spent on the report of its evidence to `report_milliseconds`.
Cell try_technique(const Run& run, const Trial& trial, const Technique& technique,
                   double& report_milliseconds) {
    Cell cell;
    cell.technique = technique.name;
    cell.summary = technique.summary;
    try {
        JudgedCell judged = judged_cell(technique, trial.traced, trial.plan, run.gpu, true);
        report_milliseconds += judged.evidence_milliseconds;
        cell = std::move(judged.cell);
    } catch (const std::bad_alloc&) {
        cell.error = cell.technique + ": " + out_of_memory;
    } catch (const Error& error) {
        cell.error = error.what();
    }
    return cell;
}

void announce(Console& console, const SceneResult& result) {
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

/// Judges the cell by the gate, and prints the result.
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
void begin_trial(const Run& run, const Scene& scene, SceneResult& result, bool begun,
                 std::optional<Trial>& trial) {
    const VerifyOptions& options = run.setup.options;
    require_scene(options.scene.memory, scene, Workload::comparison);
    require_map(options.scene.memory, options.technique.asked.map);
    result.light = chosen_light(scene);
    if (!begun) {
        result.name = scene.name;
        if (result.one_of_many) result.name += "-" + result.light.choice;
        result.name = unique_name(run.folders, result.name);
    }
    describe(result, scene);
    Plan plan = make_plan(scene);
    plan.asked = options.technique.asked;
    result.notes.insert(result.notes.end(), plan.faults.begin(), plan.faults.end());
    result.left_out = plan.left_out;
    if (!begun) announce(run.setup.console, result);

    run.setup.console.progress(fmt::format("{}: tracing", result.name));
    Tracer tracer(scene, options.scene.threads);
    result.truth = trace(tracer);
    const auto add_note = [&](const std::string& note) {
        result.notes.push_back(note);
        if (!begun) run.setup.console.line("  note: " + note);
    };
    if (const std::optional<std::string> note = note_if_nothing_is_seen(result.truth))
        add_note(*note);
    if (options.witness > 0) {
        run.setup.console.progress(fmt::format("{}: asking the witness", result.name));
        const Agreement agreement =
            ask_witness(scene, result.truth, options.witness, options.scene.threads);
        if (agreement.disagreements > 0)
            throw Error(result.name, words_of(agreement),
                        "trust no verdict on this scene, and report it: this is a fault of "
                        "shadowproof");
        add_note(words_of(agreement));
    }
    result.bump_lit = is_bump_lit(scene);
    if (result.bump_lit) result.color = shade(tracer, result.truth);
    trial.emplace(scene, result.truth, std::move(plan), std::move(tracer));
}

/// Judges the chosen techniques in turn, and reports each as soon as it is judged. Those in `tried`
/// were judged before.
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

/// An Error in `work` becomes the scene's result and does not end the run. Only for reading and
/// tracing: a report that cannot be written ends the run. Returns whether `work` succeeded.
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

/// A scene with several lights is judged under each of them, with one result for each, unless one
/// was chosen.
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
            begin_trial(run, *scene, result, goes_on, trial);
        });
        // When all bundled scenes run, one that none of the named techniques is for is skipped.
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
