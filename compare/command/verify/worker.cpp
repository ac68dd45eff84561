#include "compare/command/verify/worker.h"

#include "compare/blank.h"
#include "compare/command/judged_cell.h"
#include "compare/command/outcome.h"
#include "compare/command/pieces/report_archive.h"
#include "compare/command/process/place_in_run.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/scene_result.h"
#include "compare/command/start_gpu.h"
#include "compare/command/verify/planning.h"
#include "compare/command/verify/resumption.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "reference/witness/agreement.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <span>
#include <utility>

namespace shadowproof {

namespace {

/// State that all scenes of a worker share.
struct Run {
    const WorkerSetup& setup;
    Gpu& gpu;
    std::vector<SceneResult>& scenes; ///< so far

    /// Says what is done with a scene.
    void progress(const std::string& what) const { setup.console.progress(what); }
};

/// A scene whose truth is written.
struct WrittenScene {
    std::string content{}; ///< content_of the scene
    double milliseconds = 0;
};

SHADOWPROOF_SEND_ALL(WrittenScene, content, milliseconds)

/// A cell, judged and written.
struct DoneCell {
    Cell cell{};
    double report_milliseconds = 0; ///< spent on its ledgers and pictures
};

SHADOWPROOF_SEND_ALL(DoneCell, cell, report_milliseconds)

/// A scene's results, one for each light under which it was tried.
struct DoneScene {
    std::vector<SceneResult> results{};
    double report_milliseconds = 0;
};

SHADOWPROOF_SEND_ALL(DoneScene, results, report_milliseconds)

/// Whether a later run that goes on with this one need not try it again.
bool is_final(const DoneCell& done) {
    return done.cell.error.empty();
}
bool is_final(const DoneScene& done) {
    return std::ranges::all_of(done.results, [](const SceneResult& result) {
        return result.error.empty() &&
               std::ranges::all_of(result.cells, &std::string::empty, &Cell::error);
    });
}

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
        JudgedCell judged =
            judged_cell(technique, trial.traced, trial.plan, run.gpu,
                        {.evidence = true, .memory = run.setup.options.scene.memory});
        report_milliseconds += judged.evidence_milliseconds;
        cell = std::move(judged.cell);
    } catch (const std::bad_alloc&) {
        cell.error = cell.technique + ": " + out_of_memory;
    } catch (const Error& error) {
        cell.error = error.what();
    }
    return cell;
}

void announce(Console& console, const SceneResult& result, bool verbose) {
    // Beside a name that is not the file's own: which of several files this is.
    const bool renamed = std::filesystem::path(result.file).stem() != result.name;
    console.heading(renamed ? fmt::format("{} ({})", result.name, result.file) : result.name);
    console.line(fmt::format("  {} triangles, {}x{}, light {}", grouped(result.triangles),
                             result.width, result.height, result.light.name));
    console.notes(result.notes, verbose);
    if (!verbose) return;
    for (const std::string& clause : result.left_out) console.line("  left out: " + clause);
}

/// Column widths of one scene's cell lines.
ColumnWidths widths_of(const TechniqueOptions& techniques, const std::string& scene) {
    ColumnWidths widths{.technique = 0, .scene = static_cast<int>(scene.size()), .verdict = 0};
    for (const Technique* technique : techniques.chosen())
        widths.technique = std::max(widths.technique, static_cast<int>(technique->name.size()));
    for (const Verdict verdict : {Verdict::agrees, Verdict::fails_as_predicted, Verdict::defect,
                                  Verdict::unexplained, Verdict::timed_out})
        widths.verdict = std::max(widths.verdict, static_cast<int>(name_of(verdict).size()));
    return widths;
}

/// Prints a cell's result.
void announce(const WorkerSetup& setup, const SceneResult& scene, const Cell& cell) {
    const Gate& gate = setup.options.gate.gate;
    setup.console.cell(scene, cell, widths_of(setup.options.technique, scene.name),
                       fails(cell, gate));
    setup.console.cell_details(cell, gate);
}

/// Throws Error where the scene needs more memory than there is.
void describe_admitted(const VerifyOptions& options, const Scene& scene, SceneResult& result) {
    require_scene(options.scene.memory, scene, Workload::comparison);
    require_memory(options.scene.memory, options.technique.asked);
    describe(result, scene);
}

/// Plans and traces the chosen light of a scene that was described; the truth lies in the result.
void begin_trial(const Run& run, const Scene& scene, bool filter, SceneResult& result,
                 std::optional<Trial>& trial) {
    const VerifyOptions& options = run.setup.options;
    Plan plan = make_plan(scene);
    plan.asked = options.technique.asked;
    result.notes.insert(result.notes.end(), plan.faults.begin(), plan.faults.end());
    result.left_out = plan.left_out;
    if (const auto note = note_on_added_lights(scene)) result.notes.push_back(*note);
    announce(run.setup.console, result, options.output.verbose);

    run.progress(result.name + ": tracing");
    Tracer tracer = run.setup.pieces.step(result.name + ": tracing", [&] {
        Tracer made(scene, options.scene.threads);
        result.truth = trace(made);
        return made;
    });
    const auto add_note = [&](const std::string& note) {
        result.notes.push_back(note);
        run.setup.console.line("  note: " + note);
    };
    if (const std::optional<std::string> note = note_on_embree(embree_version())) add_note(*note);
    refuse_blank_truth(result.argument, result.truth);
    if (const std::optional<std::string> note = note_if_one_class_is_seen(result.truth)) {
        result.notes.push_back(*note);
        run.setup.console.heading("  note: " + *note);
    }
    if (options.witness > 0) {
        run.progress(result.name + ": asking the witness");
        const Agreement agreement =
            run.setup.pieces.step(result.name + ": asking the witness", [&] {
                return ask_witness(scene, result.truth, options.witness, options.scene.threads);
            });
        if (agreement.disagreements > 0)
            throw Error(result.name, words_of(agreement),
                        "trust no verdict on this scene, and report it: this is a fault of "
                        "shadowproof");
        add_note(words_of(agreement));
    }
    trial.emplace(scene, result.truth, std::move(plan), std::move(tracer));
    result.bump_lit = is_bump_lit(scene);
    if (result.bump_lit)
        result.color = shade(trial->tracer, result.truth, trial->traced.lights_before());
    if (filter) {
        run.progress(result.name + ": tracing many rays a pixel");
        result.mean_color = run.setup.pieces.step(result.name + ": tracing many rays a pixel", [&] {
            return trial->traced.pixel_means().color;
        });
    }
}

/// Judges a technique and writes what the report shows of it, as a piece. One that is lost has a
/// cell that says so.
DoneCell done_cell(const Run& run, const Trial& trial, const SceneResult& result,
                   const Technique& technique) {
    const WorkerSetup& setup = run.setup;
    const auto judge_and_write = [&] {
        const Stopwatch spent;
        DoneCell done;
        Cell& cell = done.cell;
        cell = try_technique(run, trial, technique, done.report_milliseconds);
        if (setup.baseline) compare_with(*setup.baseline, result, cell);
        if (cell.error.empty())
            cell.first_failing = first_that_fails(cell, setup.options.gate.gate);
        const Stopwatch writing;
        setup.folder.add_cell(result, cell, setup.options.scene.threads);
        done.report_milliseconds += writing.milliseconds();
        cell.spent_milliseconds = spent.milliseconds();
        return done;
    };
    try {
        bool by_this_worker = false;
        DoneCell done = setup.pieces.piece(
            std::string(technique.name),
            [&] {
                by_this_worker = true;
                return judge_and_write();
            },
            [](const DoneCell& made) { return is_final(made); });
        if (!by_this_worker) recall(setup, result, done.cell);
        return done;
    } catch (const LostPiece& lost) {
        DoneCell done;
        done.cell.technique = technique.name;
        done.cell.summary = technique.summary;
        done.cell.error = lost.what();
        if (lost.loss == Loss::timed_out) done.cell.verdict = Verdict::timed_out;
        return done;
    }
}

/// Judges techniques in turn. `since`: when the scene was begun. Returns the milliseconds spent on
/// the report.
double judge_techniques(const Run& run, const Trial& trial,
                        const std::vector<const Technique*>& techniques, const Stopwatch& since,
                        SceneResult& result) {
    const WorkerSetup& setup = run.setup;
    run.progress(result.name + ": writing");
    const WrittenScene written = setup.pieces.piece(result.name + ": writing", [&] {
        const Stopwatch writing;
        setup.folder.add_scene(result);
        return WrittenScene{content_of(result), writing.milliseconds()};
    });
    if (written.content != content_of(result)) refuse_changed(result.argument);
    result.spent_milliseconds = since.milliseconds();
    double report_milliseconds = written.milliseconds;
    for (const Technique* technique : techniques) {
        run.progress(fmt::format("{}: {}", result.name, technique->name));
        DoneCell done = done_cell(run, trial, result, *technique);
        announce(setup, result, done.cell);
        report_milliseconds += done.report_milliseconds;
        result.cells.push_back(std::move(done.cell));
    }
    return report_milliseconds;
}

/// An Error in `work`, or a loss, becomes the scene's result and does not end the run. Only for
/// reading and tracing: a report that cannot be written ends the run. Returns whether `work`
/// succeeded.
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
    if (!run.setup.pieces.catching_up()) complain(result.error);
    return false;
}

SceneResult begin_result(const std::string& argument) {
    SceneResult result;
    result.argument = argument;
    result.name = name_of_file(argument);
    result.file = argument;
    return result;
}

/// The techniques that are named, in the order of all.
std::vector<const Technique*> only(std::vector<const Technique*> all,
                                   const std::vector<std::string>& names) {
    std::erase_if(all, [&](const Technique* one) {
        return std::ranges::find(names, one->name) == names.end();
    });
    return all;
}

[[noreturn]] void refuse_replanned(const std::string& argument) {
    throw Error(argument, "is another scene than when the parts of the run were planned",
                "run all parts again, without --resume");
}

/// A scene with several lights is judged under each of them, with one result for each, unless one
/// was chosen. The results are the last of the run. `part`: what a shard tries; null: all.
double try_scene(const Run& run, const std::string& argument, const PlannedScene* part) {
    const WorkerSetup& setup = run.setup;
    std::optional<Scene> scene;
    std::size_t lights = part != nullptr ? part->lights.size() : 1;
    double report_milliseconds = 0;
    for (std::size_t i = 0; i < lights; ++i) {
        const PlannedLight* const planned = part != nullptr ? &part->lights[i] : nullptr;
        if (planned != nullptr && !planned->tried) continue;
        const Stopwatch since;
        SceneResult result = begin_result(argument);
        std::optional<Trial> trial;
        std::vector<const Technique*> techniques;
        bool none_suits = false; // when all bundled scenes run: this light is skipped
        const bool traced = attempt(run, result, [&] {
            if (!scene) {
                scene = read_scene(setup, argument);
                if (part == nullptr && request_of(setup.options).every_light)
                    lights = scene->lights.size();
            }
            result.one_of_many = lights > 1;
            if (planned != nullptr && request_of(setup.options).every_light &&
                lights != scene->lights.size())
                refuse_replanned(argument);
            if (result.one_of_many) scene->light = i;
            techniques = techniques_for(setup.options, *scene);
            const bool filter = filter_bumps(techniques, *scene); // also if another shard does
            none_suits = techniques.empty() && planned == nullptr;
            if (none_suits) return;
            if (planned != nullptr) {
                techniques = only(std::move(techniques), planned->techniques);
                if (techniques.size() != planned->techniques.size()) refuse_replanned(argument);
            }
            result.name = planned != nullptr
                              ? planned->name
                              : name_of_result(*scene, result.one_of_many, run.scenes);
            describe_admitted(setup.options, *scene, result);
            if (planned != nullptr && planned->content != content_of(result))
                refuse_replanned(argument);
            begin_trial(run, *scene, filter, result, trial);
        });
        if (none_suits) continue;
        bool written = traced;
        if (traced) {
            try {
                report_milliseconds += judge_techniques(run, *trial, techniques, since, result);
            } catch (const LostPiece& lost) { // while the pictures that cells share were written
                written = attempt(run, result, [&] { throw lost; });
            }
        }
        if (!written)
            result.name = planned != nullptr ? planned->name : unique_name(run.scenes, result.name);
        // As it is sent: its pictures are written, and dropped.
        run.scenes.push_back(unpacked<SceneResult>(packed(result)));
    }
    return report_milliseconds;
}

/// Shows what an earlier run has found, of which all files must be there.
void announce(const WorkerSetup& setup, const DoneScene& done) {
    for (const SceneResult& result : done.results) {
        for (const Cell& cell : result.cells) recall(setup, result, cell);
        announce(setup.console, result, setup.options.output.verbose);
        for (const Cell& cell : result.cells) announce(setup, result, cell);
    }
}

/// Tries a scene as a piece: a later worker does not read it again.
double done_scene(const Run& run, const std::string& argument, const PlannedScene* part) {
    const WorkerSetup& setup = run.setup;
    const std::size_t before = run.scenes.size();
    const auto results = [&] { return std::span(run.scenes).subspan(before); };
    const bool is_whole = part == nullptr || part->is_whole;
    bool by_this_worker = false;
    DoneScene done;
    try {
        done = setup.pieces.piece(
            argument,
            [&] {
                by_this_worker = true;
                DoneScene scene;
                scene.report_milliseconds = try_scene(run, argument, part);
                if (!results().empty() && is_whole) {
                    SceneResult& last = run.scenes.back();
                    last.no_longer_provoked = stopped_provoking(setup.begun, results());
                    if (!last.no_longer_provoked.empty())
                        setup.console.always(last.name + ": " + no_longer_provoked_words(last));
                }
                scene.results.assign(results().begin(), results().end());
                return scene;
            },
            [](const DoneScene& made) { return is_final(made); });
    } catch (const LostPiece& lost) {
        SceneResult& result = done.results.emplace_back(begin_result(argument));
        attempt(run, result, [&] { throw lost; });
        result.name =
            part != nullptr ? part->lights.front().name : unique_name(run.scenes, result.name);
        by_this_worker = true;
    }
    if (!by_this_worker && setup.resumed) {
        require_same_scene(setup, argument, done.results);
        announce(setup, done);
    }
    run.scenes.resize(before);
    for (SceneResult& result : done.results) run.scenes.push_back(std::move(result));
    return done.report_milliseconds;
}

} // namespace

std::vector<std::string> scenes_to_verify(const VerifyOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    std::vector<std::string> all;
    for (const BundledScene& scene : bundled_scenes()) all.emplace_back(scene.name);
    return all;
}

VerifiedScenes try_scenes(const WorkerSetup& setup) {
    const std::unique_ptr<Gpu> gpu = start_gpu(setup.pieces, setup.options.technique.platform);
    VerifiedScenes verified{.gl = gpu->driver(), .embree = embree_version(), .scenes = {}};
    require_same_driver(setup, verified.gl);
    Run run{setup, *gpu, verified.scenes};
    std::vector<PlannedScene> scenes;
    if (setup.options.shard) {
        PlannedShard shard = planned_shard(setup);
        scenes = std::move(shard.scenes);
        verified.plan = shard.plan;
    } else
        for (const std::string& argument : scenes_to_verify(setup.options))
            scenes.push_back({.argument = argument, .lights = {}});
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        setup.console.begin_part(
            place_in_run(i, scenes.size(), setup.stopwatch.milliseconds() / 1000));
        verified.report_milliseconds +=
            done_scene(run, scenes[i].argument, setup.options.shard ? &scenes[i] : nullptr);
    }
    setup.console.begin_part("");
    return verified;
}

} // namespace shadowproof
