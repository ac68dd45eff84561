#include "compare/command/bench/measure.h"

#include "compare/bench/bench_error.h"
#include "compare/bench/bench_table.h"
#include "compare/bench/kept.h"
#include "compare/command/bench/measured_archive.h"
#include "compare/command/bench/sweep.h"
#include "compare/command/judged_cell.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/scene_result.h"
#include "compare/maps/map_memory.h"
#include "compare/memory.h"
#include "compare/report/escape.h"
#include "compare/words.h"
#include "raster/render.h"
#include "reference/shade/shading.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"
#include "scenes/load/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>

namespace shadowproof {

namespace {

/// A scene, traced, and the points that are measured on it.
struct Trial {
    const BenchWork& work;
    std::string argument;
    const Scene& scene;
    const Tracer& tracer;
    const GroundTruth& truth;
    TracedScene traced;
    Plan plan;
    std::string name;                           ///< of the scene, unique in the run
    std::size_t first = 0;                      ///< its first point in the run
    std::vector<const Technique*> techniques{}; ///< of those points; null: the truth itself
    std::vector<bool> warm{};                   ///< this process has drawn them
    Stopwatch since{};                          ///< it was begun
    bool complete = true;   ///< all that was asked for was measured, but for what took too long
    bool timed_out = false; ///< something did
};

/// The plan by which a technique draws with these settings.
const Plan& plan_with(Trial& trial, const BenchSettings& settings) {
    trial.plan.asked = with_settings(trial.work.options.technique, settings).asked;
    require_map(trial.work.options.scene.memory, trial.plan.asked.map);
    return trial.plan;
}

/// The words, after the program's name, that show the same with verify.
std::vector<std::string> verify_words(const Trial& trial, const Technique& technique,
                                      const BenchSettings& with) {
    std::vector<std::string> words{"verify", trial.argument, "--technique",
                                   std::string(technique.name)};
    for (const auto& [name, value] : with) words.insert(words.end(), {"--" + name, value});
    TechniqueOptions platform; // as in bench_command
    platform.platform = trial.work.options.technique.platform;
    SceneOptions scene = trial.work.options.scene;
    if (trial.scene.lights.size() > 1) scene.light = chosen_light(trial.scene).choice;
    for (const std::string& word : settings(scene, platform)) words.push_back(word);
    return words;
}

std::string name_of_point(const Technique& technique, const BenchSettings& settings) {
    return settings.empty() ? std::string(technique.name)
                            : fmt::format("{} {}", technique.name, words_of(settings));
}

/// Draws a point, judges it and keeps its pictures.
JudgedPoint judge_point(Trial& trial, const Technique& technique, BenchPoint point) {
    const BenchWork& work = trial.work;
    Cell cell;
    try {
        cell = judged_cell(technique, trial.traced, plan_with(trial, point.settings), work.gpu,
                           {.evidence = work.pictures != nullptr})
                   .cell;
    } catch (const std::bad_alloc&) {
        return {.why = out_of_memory};
    } catch (const Error& error) {
        return {.why = error.what()};
    }
    point.family = cell.family;
    point.own = own_settings(technique, cell.frame, trial.scene.unit);
    point.error = error_of(cell.frame, cell.comparison, trial.truth.visibility);
    if (work.pictures != nullptr) {
        cell.command = verify_words(trial, technique, point.settings);
        point.pictures =
            work.pictures->add(point.settings, std::move(cell), work.options.scene.threads);
    }
    return {.point = std::move(point)};
}

/// Adds a point, as an earlier run had it or newly drawn and judged. Returns null where it cannot
/// be drawn; then `why` says so. Throws LostPiece.
const BenchPoint* add_point(Trial& trial, const Technique& technique, const BenchSettings& settings,
                            std::string& why) {
    const BenchWork& work = trial.work;
    BenchPoint point{.scene = trial.name,
                     .technique = std::string(technique.name),
                     .family = {},
                     .settings = settings,
                     .own = {},
                     .samples = {},
                     .error = {},
                     .command = bench_command(work.options, trial.argument,
                                              std::string(technique.name), settings)};
    const BenchPoint* const known = work.kept != nullptr ? find_point(*work.kept, point) : nullptr;
    if (known != nullptr) {
        point = *known;
        point.pictures.clear(); // they are made anew, for this plot
    }
    bool warm = false;
    if (known == nullptr || work.pictures != nullptr) {
        const std::string named = name_of_point(technique, settings);
        work.console.progress(fmt::format("{}: judging {}", trial.name, named));
        JudgedPoint judged = work.pieces.piece("judging " + named, [&] {
            warm = true;
            return judge_point(trial, technique, point);
        });
        if (!judged.point) {
            why = judged.why;
            return nullptr;
        }
        point = std::move(*judged.point);
    }
    trial.techniques.push_back(&technique);
    trial.warm.push_back(warm);
    return &work.run.points.emplace_back(std::move(point));
}

void leave_out(Trial& trial, const Technique& technique, const BenchSettings& settings,
               const std::string& why, Loss loss = Loss::none) {
    trial.work.run.left_out.push_back(
        {trial.name, std::string(technique.name), settings, why, loss});
}

/// Says once what was lost, and leaves it out.
void lose(Trial& trial, const Technique& technique, const BenchSettings& settings,
          const LostPiece& lost) {
    if (!trial.work.pieces.catching_up()) complain(fmt::format("{}: {}", trial.name, lost.what()));
    leave_out(trial, technique, settings, lost.what(), lost.loss);
    if (lost.loss == Loss::timed_out)
        trial.timed_out = true;
    else
        trial.complete = false;
}

/// The exact truth is its own yardstick: no pixel of it is wrong.
void add_truth(Trial& trial) {
    const BenchWork& work = trial.work;
    BenchPoint point{.scene = trial.name,
                     .technique = truth_point,
                     .family = truth_point,
                     .settings = {},
                     .own = {},
                     .samples = {},
                     .error = {.pixels = trial.truth.visibility.pixels.size()},
                     .command = bench_command(work.options, trial.argument, {}, {})};
    if (work.kept != nullptr)
        if (const BenchPoint* known = find_point(*work.kept, point)) point = *known;
    work.run.points.push_back(std::move(point));
    trial.techniques.push_back(nullptr);
    trial.warm.push_back(true); // it was traced, or is measured as it was before
}

/// The settings by flags that a technique heeds.
BenchSettings fixed_for(const Trial& trial, const Technique& technique) {
    BenchSettings fixed;
    for (const SweptSetting& setting : swept_settings())
        for (const auto& each : trial.work.options.fixed)
            if (each.first == setting.name && heeds(technique, setting.name)) fixed.push_back(each);
    return fixed;
}

void add_points_of(Trial& trial, const Technique& technique) {
    const BenchSettings fixed = fixed_for(trial, technique);
    std::string why;
    BenchSettings own_of_technique;
    try {
        const BenchPoint* const own = add_point(trial, technique, fixed, why);
        if (own == nullptr) {
            if (!trial.work.pieces.catching_up()) complain(why);
            leave_out(trial, technique, fixed, why);
            trial.complete = false;
            return;
        }
        own_of_technique = own->own;
    } catch (const LostPiece& lost) {
        lose(trial, technique, fixed, lost);
        // Each further setting would take as long.
        if (lost.loss == Loss::timed_out) return;
    }
    for (const BenchSettings& settings :
         sweep(technique, fixed, own_of_technique, trial.work.options.quick)) {
        try {
            if (add_point(trial, technique, settings, why) == nullptr)
                leave_out(trial, technique, settings, why); // not all forms suit all maps
        } catch (const LostPiece& lost) {
            lose(trial, technique, settings, lost);
        }
    }
}

void add_points(Trial& trial) {
    const BenchOptions& options = trial.work.options;
    add_truth(trial);
    for (const Technique* technique : options.technique.chosen())
        // What is named is drawn, or says why it is not for such a scene.
        if (!options.technique.techniques.empty() || suits(*technique, trial.scene))
            add_points_of(trial, *technique);
}

/// Adds a sample's stages, each after those of earlier samples.
void add_stages(std::vector<BenchStage>& stages, const BenchSample& sample) {
    for (const BenchStage& stage : sample.stages) {
        auto found = std::find_if(stages.begin(), stages.end(),
                                  [&](const BenchStage& each) { return each.name == stage.name; });
        if (found == stages.end()) found = stages.insert(found, {stage.name, {}});
        found->samples.insert(found->samples.end(), stage.samples.begin(), stage.samples.end());
    }
}

/// One sample of the trial's i-th point. Throws LostPiece.
BenchSample take_sample(Trial& trial, std::size_t i) {
    const BenchWork& work = trial.work;
    const Technique* const technique = trial.techniques[i];
    const BenchSettings& settings = work.run.points[trial.first + i].settings;
    const std::string named =
        technique == nullptr ? std::string(truth_point) : name_of_point(*technique, settings);
    return work.pieces.piece("measuring " + named, [&]() -> BenchSample {
        if (technique == nullptr) return {trace(trial.tracer).statistics.milliseconds, {}};
        const auto draw = [&] {
            return render(*technique, trial.scene, plan_with(trial, settings), work.gpu);
        };
        if (!trial.warm[i]) draw();
        trial.warm[i] = true;
        const Frame frame = draw();
        BenchSample sample{.milliseconds = frame.milliseconds};
        for (const Stage& stage : frame.stages)
            sample.stages.push_back({std::string(stage.name), {stage.milliseconds}});
        return sample;
    });
}

/// Points that were lost while they were measured have no result.
void remove_points(Trial& trial, const std::vector<bool>& lost) {
    std::vector<BenchPoint>& points = trial.work.run.points;
    for (std::size_t i = lost.size(); i-- > 0;)
        if (lost[i]) points.erase(points.begin() + static_cast<std::ptrdiff_t>(trial.first + i));
}

void measure(Trial& trial) {
    const BenchWork& work = trial.work;
    BenchRun& run = work.run;
    std::vector<std::vector<double>> samples;
    std::vector<std::vector<BenchStage>> stages;
    for (std::size_t i = trial.first; i < run.points.size(); ++i) {
        samples.push_back(run.points[i].samples);
        stages.push_back(run.points[i].stages);
    }
    std::vector<bool> lost(samples.size());
    RoundLimits limits = work.options.limits;
    if (const double whole = work.options.scene_seconds; whole > 0)
        limits.seconds = std::clamp(whole - trial.since.milliseconds() / 1000, 0.0, limits.seconds);
    const Stopwatch stopwatch;
    measure_in_rounds(
        samples, limits,
        {.measure = [&](std::size_t i) -> std::optional<double> {
             try {
                 const BenchSample sample = take_sample(trial, i);
                 // As many as the samples: none where an earlier run has samples alone.
                 if (!stages[i].empty() || samples[i].empty()) add_stages(stages[i], sample);
                 return sample.milliseconds;
             } catch (const LostPiece& error) {
                 if (trial.techniques[i] == nullptr) throw; // without the truth nothing is
                 lose(trial, *trial.techniques[i], run.points[trial.first + i].settings, error);
                 lost[i] = true;
                 return std::nullopt;
             }
         },
         .seconds = [&] { return stopwatch.milliseconds() / 1000; },
         .before =
             [&](std::size_t i) {
                 const auto done = std::count_if(
                     samples.begin(), samples.end(),
                     [&](const std::vector<double>& each) { return is_done(each, limits); });
                 const BenchPoint& point = run.points[trial.first + i];
                 work.console.progress(
                     fmt::format("{}{}: {} of {} points done, sample {} of {} {}; at most {:.0f} s "
                                 "for the scene",
                                 work.place, trial.name, done, samples.size(),
                                 samples[i].size() + 1, point.technique, words_of(point.settings),
                                 std::max(0.0, limits.seconds - stopwatch.milliseconds() / 1000)));
             },
         .after_round =
             [&] {
                 for (std::size_t i = 0; i < samples.size(); ++i) {
                     run.points[trial.first + i].samples = samples[i];
                     run.points[trial.first + i].stages = stages[i];
                 }
                 if (!work.pieces.catching_up()) work.keeper.keep(run);
             }});
    remove_points(trial, lost);
}

/// Two files may have one stem: the second is "stem-2".
std::string unique_name(const BenchRun& run, const std::string& wanted) {
    std::string name = wanted;
    const auto is_taken = [&](const BenchScene& scene) { return scene.name == name; };
    for (int number = 2; std::any_of(run.scenes.begin(), run.scenes.end(), is_taken); ++number)
        name = fmt::format("{}-{}", wanted, number);
    return name;
}

/// `kept`: an earlier run; null: none. The scene has the name that it had there.
BenchScene describe(const BenchRun& run, const BenchRun* kept, const Scene& scene,
                    const std::string& argument) {
    BenchScene described{.name = unique_name(run, scene.name),
                         .file =
                             (is_bundled(argument) ? scene.file.filename() : scene.file).string(),
                         .digest = digest_of(scene),
                         .light = chosen_light(scene).name,
                         .width = static_cast<std::uint64_t>(scene.camera.width),
                         .height = static_cast<std::uint64_t>(scene.camera.height),
                         .triangles = scene.triangles.size(),
                         .finished = false};
    if (kept == nullptr) return described;
    for (const BenchScene& known : kept->scenes)
        if (are_one_picture(known, described) && known.file == described.file &&
            unique_name(run, known.name) == known.name) {
            described.name = known.name;
            break;
        }
    return described;
}

/// Whether an earlier run has each technique that is asked for now, or says why not.
bool has_all(const BenchRun& kept, const BenchScene& scene, const BenchWork& work,
             const Scene& read) {
    const TechniqueOptions& options = work.options.technique;
    return std::ranges::all_of(options.chosen(), [&](const Technique* technique) {
        const auto is_its = [&](const auto& each) {
            return each.scene == scene.name && each.technique == technique->name;
        };
        return (options.techniques.empty() && !suits(*technique, read)) ||
               std::ranges::any_of(kept.points, is_its) ||
               std::ranges::any_of(kept.left_out, is_its);
    });
}

/// Whether an earlier run had finished the scene: its points are taken over, but where pictures are
/// wanted, which are drawn anew. Throws Error where it had another scene of that name.
bool take_over(const BenchWork& work, BenchScene& scene, const Scene& read) {
    if (work.kept == nullptr) return false;
    const BenchScene* const kept = kept_scene(work.options.json, *work.kept, scene);
    if (work.pictures != nullptr || kept == nullptr || !kept->finished ||
        !has_all(*work.kept, scene, work, read))
        return false;
    scene.finished = true;
    for (const BenchPoint& point : work.kept->points)
        if (point.scene == scene.name) work.run.points.push_back(point);
    for (const BenchLeftOut& out : work.kept->left_out)
        if (out.scene == scene.name) work.run.left_out.push_back(out);
    return true;
}

/// What the report of the pictures tells of the scene, whose truth lies in it.
void describe(SceneResult& result, const Trial& trial) {
    result.argument = trial.argument;
    result.name = trial.name;
    describe(result, trial.scene);
    result.left_out = trial.plan.left_out;
    result.bump_lit = is_bump_lit(trial.scene);
    if (result.bump_lit) result.color = shade(trial.tracer, trial.truth);
}

void print_points(const BenchWork& work, const std::string& scene) {
    for (const std::string& line : bench_table(work.run, scene)) work.console.line(line);
    for (const BenchLeftOut& out : work.run.left_out)
        if (out.scene == scene)
            work.console.line(fmt::format("  left out: {} {}: {}", out.technique,
                                          words_of(out.settings), out.why));
}

} // namespace

std::string bench_command(const BenchOptions& options, const std::string& scene,
                          const std::string& technique, const BenchSettings& settings_given) {
    std::string command = "shadowproof bench " + shell_quoted(scene);
    if (!technique.empty()) command += " --technique " + technique;
    TechniqueOptions platform; // settings are named one by one, those of other techniques left out
    platform.platform = options.technique.platform;
    for (const auto& [name, value] : settings_given)
        command += fmt::format(" --{} {}", name, shell_quoted(value));
    for (const std::string& word : settings(options.scene, platform))
        command += " " + shell_quoted(word);
    return command;
}

bool measure_scene(const BenchWork& work, const std::string& argument) {
    const BenchOptions& options = work.options;
    work.console.progress(work.place + argument + ": reading");
    const Scene scene = work.pieces.step(
        argument + ": reading", [&] { return load_scene(argument, options.scene.request()); });
    require_scene(options.scene.memory, scene, Workload::comparison);
    BenchScene described = describe(work.run, work.kept, scene, argument);
    const std::string name = described.name;
    const bool is_known = take_over(work, described, scene);
    const std::size_t at = work.run.scenes.size();
    work.run.scenes.push_back(std::move(described));
    work.console.heading(name);
    work.console.line(fmt::format("  {} triangles, {}x{}, light {}",
                                  grouped(scene.triangles.size()), scene.camera.width,
                                  scene.camera.height, chosen_light(scene).name));
    for (const std::string& note : scene.notes) work.console.line("  note: " + note);
    if (is_known) {
        work.console.line("  as measured before");
        print_points(work, name);
        return true;
    }
    work.console.progress(work.place + name + ": tracing");
    SceneResult result;
    std::optional<Tracer> traced;
    work.pieces.step(name + ": tracing", [&] {
        traced.emplace(scene, options.scene.threads);
        result.truth = trace(*traced);
    });
    const Tracer& tracer = *traced;
    const GroundTruth& truth = result.truth;
    Trial trial{.work = work,
                .argument = argument,
                .scene = scene,
                .tracer = tracer,
                .truth = truth,
                .traced = TracedScene(tracer, truth),
                .plan = make_plan(scene),
                .name = name,
                .first = work.run.points.size(),
                .techniques = {}};
    if (work.pictures != nullptr) {
        describe(result, trial);
        work.pictures->begin(result);
    }
    add_points(trial);
    measure(trial);
    work.run.scenes[at].finished = trial.complete && !trial.timed_out;
    if (!work.pieces.catching_up()) work.keeper.keep(work.run);
    print_points(work, name);
    return trial.complete;
}

} // namespace shadowproof
