#include "compare/command/stress/sweep.h"

#include "compare/bench/bench_error.h"
#include "compare/command/bench/sweep.h"
#include "compare/command/judged_cell.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/scene_result.h"
#include "compare/command/stress/stress_archive.h"
#include "compare/memory.h"
#include "compare/report/escape.h"
#include "compare/stress/breaking.h"
#include "compare/stress/stress_table.h"
#include "compare/words.h"
#include "reference/shade/shading.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"
#include "scenes/load/admission.h"
#include "scenes/load/catalog.h"
#include "scenes/load/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace shadowproof {

namespace {

/// A scene that is taken along a parameter.
struct Sweep {
    const StressWork& work;
    std::string argument;
    const Scene& scene; ///< as it is
    std::string name;   ///< unique in the run
    std::vector<const Technique*> techniques{};
    TechniqueOptions settings{}; ///< of all techniques, at the point at hand
    const StressParameter* parameter = nullptr;
    StressAlong along{};
    std::string place{}; ///< ", parameter 3 of 19"; empty for the scene as it is
};

/// The words, after the program's name, that show a cell again.
std::vector<std::string> verify_words(const Sweep& sweep, const std::string& technique,
                                      const std::optional<Stress>& stress) {
    std::vector<std::string> words{"verify", sweep.argument, "--technique", technique};
    SceneOptions scene = sweep.work.options.scene;
    if (sweep.scene.lights.size() > 1) scene.light = chosen_light(sweep.scene).choice;
    if (stress && sweep.parameter->take != nullptr) scene.stress = stress;
    for (const std::string& word : settings(scene, sweep.settings)) words.push_back(word);
    return words;
}

std::string command_of(const std::vector<std::string>& words) {
    std::string command = "shadowproof";
    for (const std::string& word : words) command += " " + shell_quoted(word);
    return command;
}

SceneResult traced_result(const Tracer& tracer) {
    SceneResult result;
    result.truth = trace(tracer);
    return result;
}

/// A point's scene, traced.
struct StressTrial {
    const Scene& scene;
    Tracer tracer;
    SceneResult result; ///< with the truth
    TracedScene traced;
    Plan plan;
    std::optional<Stress> stress; ///< none: the scene as it is

    StressTrial(const Scene& at, const Sweep& sweep, std::optional<Stress> by)
        : scene(at), tracer(at, sweep.work.options.scene.threads), result(traced_result(tracer)),
          traced(tracer, result.truth), plan(make_plan(at)), stress(std::move(by)) {
        plan.asked = sweep.settings.asked;
        result.argument = sweep.argument;
        result.name = sweep.name;
        describe(result, scene);
        result.left_out = plan.left_out;
        result.bump_lit = is_bump_lit(scene);
    }
};

std::string place_of(const std::optional<Stress>& stress) {
    return stress ? words_of(*stress) : std::string("as it is");
}

/// Says once what was lost.
void complain_of(const Sweep& sweep, const std::string& place, const LostPiece& lost) {
    if (!sweep.work.pieces.catching_up())
        complain(fmt::format("{}, {}: {}", sweep.name, place, lost.what()));
}

StressCell draw(const Sweep& sweep, StressTrial& trial, const Technique& technique) {
    StressCell tried{.technique = std::string(technique.name)};
    const std::vector<std::string> words = verify_words(sweep, tried.technique, trial.stress);
    tried.command = command_of(words);
    const PointPictures* const pictures = sweep.work.pictures;
    const Stopwatch stopwatch;
    try {
        JudgedCell judged = judged_cell(technique, trial.traced, trial.plan, sweep.work.gpu,
                                        {.evidence = pictures != nullptr,
                                         .memory = sweep.work.options.scene.memory,
                                         .strain = true});
        Cell& cell = judged.cell;
        tried.judging = stopwatch.milliseconds();
        tried.strain = judged.strain;
        tried.family = cell.family;
        tried.milliseconds = cell.milliseconds;
        tried.error = error_of(cell.frame, cell.comparison, trial.result.truth.visibility);
        tried.verdict = cell.verdict;
        if (pictures != nullptr) {
            cell.command = words;
            BenchSettings settings;
            if (trial.stress)
                settings.emplace_back(trial.stress->parameter, value_words(trial.stress->value));
            tried.pictures = sweep.work.pictures->add(settings, std::move(cell),
                                                      sweep.work.options.scene.threads);
        }
    } catch (const std::bad_alloc&) {
        tried.refused = out_of_memory;
    } catch (const Error& error) {
        tried.refused = error.what();
    }
    return tried;
}

StressCell try_technique(const Sweep& sweep, StressTrial& trial, const Technique& technique) {
    const std::string name(technique.name);
    try {
        return sweep.work.pieces.piece(name, [&] { return draw(sweep, trial, technique); });
    } catch (const LostPiece& lost) {
        complain_of(sweep, place_of(trial.stress), lost);
        return {.technique = name,
                .refused = lost.what(),
                .loss = lost.loss,
                .command = command_of(verify_words(sweep, name, trial.stress))};
    }
}

/// Traces the scene at a value, asks the witness, and judges techniques there.
void try_point(const Sweep& sweep, const Scene& scene, std::optional<Stress> stress,
               const std::vector<const Technique*>& techniques, StressPoint& point) {
    const StressWork& work = sweep.work;
    const std::string place = place_of(stress);
    const auto progress = [&](std::string_view what) {
        work.console.progress(fmt::format("{}{}: {}: {}", sweep.name, sweep.place, place, what));
    };
    progress("tracing");
    require_scene(work.options.scene.memory, scene, Workload::comparison);
    std::optional<StressTrial> traced;
    work.pieces.step("tracing", [&] { traced.emplace(scene, sweep, std::move(stress)); });
    StressTrial& trial = *traced;
    SceneResult& result = trial.result;
    const TraceStatistics& statistics = result.truth.statistics;
    point.triangles = scene.triangles.size();
    point.trace_milliseconds = statistics.milliseconds;
    point.rays = statistics.rays;
    point.exact_decisions = statistics.exact_decisions;
    point.degenerate = statistics.degenerate;
    progress("asking the witness");
    point.witness = work.pieces.piece("asking the witness", [&] {
        return ask_witness(scene, result.truth, work.options.witness, work.options.scene.threads);
    });
    if (point.witness.disagreements > 0) result.notes.push_back(words_of(point.witness));
    progress("telling the scene otherwise");
    point.relations = work.pieces.piece("telling the scene otherwise", [&] {
        return check_relations(scene, result.truth, work.options.scene.threads);
    });
    if (point.relations.changed > 0) result.notes.push_back(words_of(point.relations));
    if (result.bump_lit)
        result.color = shade(trial.tracer, result.truth, trial.traced.lights_before());
    if (filter_bumps(techniques, scene)) result.mean_color = trial.traced.pixel_means().color;
    if (work.pictures != nullptr) work.pictures->begin(result, place);
    for (const Technique* technique : techniques) {
        progress(technique->name);
        point.cells.push_back(try_technique(sweep, trial, *technique));
    }
}

/// A point that was lost while it was traced has neither truth nor cells.
void lose(const Sweep& sweep, const std::string& place, const LostPiece& lost, StressPoint& point) {
    complain_of(sweep, place, lost);
    point.refused = lost.what();
    point.loss = lost.loss;
}

/// The scene as it is. One that is refused is of no use at any value.
StressPoint own_point(const Sweep& sweep) {
    StressPoint point{.own = true};
    const std::string place = place_of(std::nullopt);
    try {
        return sweep.work.pieces.piece(place, [&] {
            StressPoint tried = point;
            try_point(sweep, sweep.scene, std::nullopt, sweep.techniques, tried);
            return tried;
        });
    } catch (const LostPiece& lost) {
        lose(sweep, place, lost, point);
    }
    return point;
}

/// The sweep with the parameter's flag at a value.
Sweep with_setting(const Sweep& sweep, double value) {
    Sweep set = sweep;
    const double taken = sweep.parameter->flag_value(sweep.scene, value);
    set.settings = with_settings(sweep.settings,
                                 {{std::string(sweep.parameter->flag), fmt::format("{}", taken)}});
    return set;
}

/// Adds the point of a value, or what is still missing there.
void add_point(Sweep& sweep, double value, bool searched,
               const std::vector<const Technique*>& techniques) {
    StressPoint point{.value = value, .searched = searched};
    const Stress stress{std::string(sweep.parameter->name), value};
    try {
        point = sweep.work.pieces.piece(words_of(stress), [&] {
            StressPoint tried = point;
            if (sweep.parameter->take == nullptr) {
                try_point(with_setting(sweep, value), sweep.scene, stress, techniques, tried);
                return tried;
            }
            Scene scene = stressed(sweep.scene, stress);
            admit(scene);
            try_point(sweep, scene, stress, techniques, tried);
            return tried;
        });
    } catch (const std::bad_alloc&) {
        point.refused = out_of_memory;
    } catch (const LostPiece& lost) {
        lose(sweep, words_of(stress), lost, point);
    } catch (const Error& error) {
        point.refused = error.what();
    }
    const auto after = std::ranges::upper_bound(sweep.along.points, value, {}, &StressPoint::value);
    sweep.along.points.insert(after, std::move(point));
}

std::vector<const Technique*> named(const Sweep& sweep, const std::vector<std::string>& names) {
    std::vector<const Technique*> found;
    for (const Technique* technique : sweep.techniques)
        if (std::ranges::count(names, technique->name) > 0) found.push_back(technique);
    return found;
}

/// One side of the scene's own value: the ladder, then the breaking points by bisection.
void sweep_side(Sweep& sweep, bool up) {
    for (const double value : ladder(*sweep.parameter, sweep.scene, up))
        add_point(sweep, value, false, sweep.techniques);
    while (const std::optional<Search> search =
               next_search(breaking_points(sweep.along, up), sweep.parameter->whole))
        add_point(sweep, search->value, true, named(sweep, search->techniques));
    for (Breaking& breaking : breaking_points(sweep.along, up))
        sweep.along.breaking.push_back(std::move(breaking));
}

/// The techniques that a parameter can make a difference to.
std::vector<const Technique*> concerned(const std::vector<const Technique*>& techniques,
                                        const StressParameter& parameter) {
    std::vector<const Technique*> some;
    for (const Technique* technique : techniques)
        if (parameter.take != nullptr || heeds(*technique, parameter.flag))
            some.push_back(technique);
    return some;
}

/// `sweep`: with the techniques that the parameter concerns. `own`: the scene as it is, with all.
StressAlong sweep_along(Sweep sweep, const StressParameter& parameter, const StressPoint& own) {
    sweep.parameter = &parameter;
    sweep.along = {.parameter = std::string(parameter.name), .words = std::string(parameter.words)};
    StressPoint& point = sweep.along.points.emplace_back(own);
    point.value = parameter.own(sweep.scene);
    std::erase_if(point.cells, [&](const StressCell& cell) {
        return std::ranges::none_of(sweep.techniques, [&](const Technique* technique) {
            return technique->name == cell.technique;
        });
    });
    for (const StressCell& cell : point.cells)
        if (cell.refused.empty() && has_failed(cell))
            sweep.along.wrong_before.push_back(cell.technique);
    sweep_side(sweep, false);
    sweep_side(sweep, true);
    return std::move(sweep.along);
}

StressScene describe(const StressRun& run, const Scene& scene, const std::string& argument) {
    StressScene described{.name = scene.name,
                          .file =
                              (is_bundled(argument) ? scene.file.filename() : scene.file).string(),
                          .digest = digest_of(scene),
                          .light = chosen_light(scene).name,
                          .width = static_cast<std::uint64_t>(scene.camera.width),
                          .height = static_cast<std::uint64_t>(scene.camera.height),
                          .triangles = scene.triangles.size()};
    // Two files may have one stem: the second is "stem-2".
    const auto is_taken = [&](const StressScene& other) { return other.name == described.name; };
    for (int number = 2; std::ranges::any_of(run.scenes, is_taken); ++number)
        described.name = fmt::format("{}-{}", scene.name, number);
    return described;
}

std::vector<const StressParameter*> asked_parameters(const StressOptions& options) {
    std::vector<const StressParameter*> asked;
    for (const StressParameter& each : stress_parameters())
        if (options.parameters.empty() || std::ranges::count(options.parameters, each.name) > 0)
            asked.push_back(&each);
    return asked;
}

} // namespace

StressScene stress_scene(const StressWork& work, const std::string& argument) {
    const StressOptions& options = work.options;
    work.console.progress(argument + ": reading");
    const Scene scene = work.pieces.step(
        argument + ": reading", [&] { return load_scene(argument, options.scene.request()); });
    StressScene described = describe(work.run, scene, argument);
    work.console.heading(described.name);
    work.console.line(fmt::format("  {} triangles, {}x{}, light {}",
                                  grouped(scene.triangles.size()), scene.camera.width,
                                  scene.camera.height, chosen_light(scene).name));
    for (const std::string& note : scene.notes) work.console.line("  note: " + note);

    Sweep sweep{.work = work,
                .argument = argument,
                .scene = scene,
                .name = described.name,
                .settings = options.technique};
    for (const Technique* technique : options.technique.chosen())
        if (!options.technique.techniques.empty() || suits(*technique, scene))
            sweep.techniques.push_back(technique);
    const StressPoint own = own_point(sweep);

    const std::vector<const StressParameter*> parameters = asked_parameters(options);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const StressParameter& parameter = *parameters[i];
        Sweep along = sweep;
        along.techniques = concerned(sweep.techniques, parameter);
        if (!parameter.suits(scene) || along.techniques.empty()) {
            described.left_out.emplace_back(parameter.name);
            continue;
        }
        along.place = fmt::format(", parameter {} of {}", i + 1, parameters.size());
        described.parameters.push_back(sweep_along(std::move(along), parameter, own));
        work.console.clear_progress();
        for (const std::string& line : stress_table(described.parameters.back()))
            work.console.line(line);
    }
    for (const std::string& name : described.left_out)
        work.console.line(
            fmt::format("  left out: {} does not suit the scene or the techniques", name));
    return described;
}

} // namespace shadowproof
