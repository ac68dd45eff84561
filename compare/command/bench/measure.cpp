#include "compare/command/bench/measure.h"

#include "compare/bench/bench_error.h"
#include "compare/bench/bench_table.h"
#include "compare/command/bench/again.h"
#include "compare/command/bench/measured_archive.h"
#include "compare/command/bench/measured_scene.h"
#include "compare/command/bench/sampled_truth.h"
#include "compare/command/bench/sweep.h"
#include "compare/command/judged_cell.h"
#include "compare/command/process/place_in_run.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/scene_result.h"
#include "compare/families.h"
#include "compare/memory.h"
#include "compare/words.h"
#include "raster/render.h"
#include "reference/shade/shading.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>
#include <string_view>

namespace shadowproof {

namespace {

/// A scene, traced, and the points that are measured on it.
struct BenchTrial {
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
    std::size_t judged = 0;                     ///< techniques, each with all its settings
    std::size_t to_judge = 0;                   ///< how many there are
    Stopwatch judging{};                        ///< since the first of them
    bool complete = true;   ///< all that was asked for was measured, but for what took too long
    bool timed_out = false; ///< something did
};

/// The plan by which a technique draws with these settings.
const Plan& plan_with(BenchTrial& trial, const BenchSettings& settings) {
    trial.plan.asked = with_settings(trial.work.options.technique, settings).asked;
    require_memory(trial.work.options.scene.memory, trial.plan.asked);
    return trial.plan;
}

std::string name_of_point(const Technique& technique, const BenchSettings& settings) {
    return settings.empty() ? std::string(technique.name)
                            : fmt::format("{} {}", technique.name, words_of(settings));
}

/// Draws a point, judges it and keeps its pictures.
JudgedPoint judge_point(BenchTrial& trial, const Technique& technique, BenchPoint point) {
    const BenchWork& work = trial.work;
    Cell cell;
    try {
        cell =
            judged_cell(technique, trial.traced, plan_with(trial, point.settings), work.gpu,
                        {.evidence = work.pictures != nullptr, .memory = work.options.scene.memory})
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
        cell.command =
            verify_words(work.options, trial.scene, trial.argument, technique, point.settings);
        point.pictures =
            work.pictures->add(point.settings, std::move(cell), work.options.scene.threads);
    }
    return {.point = std::move(point)};
}

/// Adds a point, as an earlier run had it or newly drawn and judged. Returns null where it cannot
/// be drawn; then `why` says so. Throws LostPiece.
const BenchPoint* add_point(BenchTrial& trial, const Technique& technique,
                            const BenchSettings& settings, std::string& why) {
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
        work.console.progress(fmt::format(
            "{}: technique {} of {}, judging {}{}", trial.name, trial.judged + 1, trial.to_judge,
            named, time_left(trial.judged, trial.to_judge, trial.judging.milliseconds() / 1000)));
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

void leave_out(BenchTrial& trial, std::string_view technique, const BenchSettings& settings,
               const std::string& why, Loss loss = Loss::none) {
    trial.work.run.left_out.push_back({trial.name, std::string(technique), settings, why, loss});
}

/// Says once what was lost, and leaves it out.
void lose(BenchTrial& trial, std::string_view technique, const BenchSettings& settings,
          const LostPiece& lost) {
    if (!trial.work.pieces.catching_up()) complain(fmt::format("{}: {}", trial.name, lost.what()));
    leave_out(trial, technique, settings, lost.what(), lost.loss);
    if (lost.loss == Loss::timed_out)
        trial.timed_out = true;
    else
        trial.complete = false;
}

/// The exact truth is its own yardstick: no pixel of it is wrong.
void add_truth(BenchTrial& trial) {
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

BenchSettings unfiltered_setting() {
    return {{"filters", "off"}};
}

/// The same by exact arithmetic alone: what the filters save. It takes long, and tells nothing of
/// techniques.
void add_unfiltered_truth(BenchTrial& trial) {
    const BenchWork& work = trial.work;
    if (work.options.quick || !work.options.technique.techniques.empty()) return;
    BenchPoint point = work.run.points[trial.first];
    point.settings = unfiltered_setting();
    point.samples.clear();
    if (work.kept != nullptr)
        if (const BenchPoint* known = find_point(*work.kept, point)) point = *known;
    work.run.points.push_back(std::move(point));
    trial.techniques.push_back(nullptr);
    trial.warm.push_back(true);
}

/// Where bumps are lit and no technique is named, which the truth's means would outlast.
void add_sampled_truth(BenchTrial& trial) {
    const BenchWork& work = trial.work;
    if (!is_bump_lit(trial.scene) || !work.options.technique.techniques.empty()) return;
    BenchPoint mean = work.run.points[trial.first]; // the truth itself
    const std::vector<int> sides = sampled_sides(work.options.quick);
    std::vector<BenchPoint> points;
    for (const int side : sides) {
        mean.settings = samples_setting(side);
        if (const BenchPoint* known = work.kept != nullptr ? find_point(*work.kept, mean) : nullptr)
            points.push_back(*known);
    }
    if (points.size() != sides.size()) {
        const char* const what = "tracing many rays per pixel";
        work.console.progress(trial.name + ": " + what);
        try {
            points =
                work.pieces.piece(what, [&] { return judge_sampled(trial.traced, mean, sides); });
        } catch (const LostPiece& lost) {
            lose(trial, truth_point, mean.settings, lost);
            return;
        }
    }
    for (BenchPoint& point : points) {
        work.run.points.push_back(std::move(point));
        trial.techniques.push_back(nullptr);
        trial.warm.push_back(true);
    }
}

/// The settings by flags that a technique heeds.
BenchSettings fixed_for(const BenchTrial& trial, const Technique& technique) {
    BenchSettings fixed;
    for (const SweptSetting& setting : swept_settings())
        for (const auto& each : trial.work.options.fixed)
            if (each.first == setting.name && heeds(technique, setting.name)) fixed.push_back(each);
    return fixed;
}

void add_points_of(BenchTrial& trial, const Technique& technique) {
    const BenchSettings fixed = fixed_for(trial, technique);
    std::string why;
    BenchSettings own_of_technique;
    try {
        const BenchPoint* const own = add_point(trial, technique, fixed, why);
        if (own == nullptr) {
            if (!trial.work.pieces.catching_up()) complain(why);
            leave_out(trial, technique.name, fixed, why);
            trial.complete = false;
            return;
        }
        own_of_technique = own->own;
    } catch (const LostPiece& lost) {
        lose(trial, technique.name, fixed, lost);
        // Each further setting would take as long.
        if (lost.loss == Loss::timed_out) return;
    }
    for (const BenchSettings& settings :
         sweep(technique, fixed, own_of_technique, trial.work.options.quick)) {
        try {
            if (add_point(trial, technique, settings, why) == nullptr)
                leave_out(trial, technique.name, settings, why); // not all forms suit all maps
        } catch (const LostPiece& lost) {
            lose(trial, technique.name, settings, lost);
        }
    }
}

/// What is named is drawn, or says why it is not for such a scene.
std::vector<const Technique*> techniques_for(const BenchTrial& trial) {
    const TechniqueOptions& options = trial.work.options.technique;
    std::vector<const Technique*> techniques = options.chosen();
    if (options.techniques.empty())
        std::erase_if(techniques,
                      [&](const Technique* each) { return !suits(*each, trial.scene); });
    return techniques;
}

void add_points(BenchTrial& trial) {
    add_truth(trial);
    add_unfiltered_truth(trial);
    add_sampled_truth(trial);
    const std::vector<const Technique*> techniques = techniques_for(trial);
    trial.to_judge = techniques.size();
    trial.judging = Stopwatch();
    for (const Technique* technique : techniques) {
        add_points_of(trial, *technique);
        ++trial.judged;
    }
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
BenchSample take_sample(BenchTrial& trial, std::size_t i) {
    const BenchWork& work = trial.work;
    const Technique* const technique = trial.techniques[i];
    const BenchSettings& settings = work.run.points[trial.first + i].settings;
    const std::string named =
        technique == nullptr ? std::string(truth_point) : name_of_point(*technique, settings);
    return work.pieces.piece("measuring " + named, [&]() -> BenchSample {
        if (const int side = side_of(settings); technique == nullptr && side > 0) {
            const TracedLights& before = trial.traced.lights_before();
            const Stopwatch stopwatch;
            shade_supersampled(trial.tracer, side, before);
            return {stopwatch.milliseconds(), {}};
        }
        if (technique == nullptr) {
            const Filters filters = settings == unfiltered_setting() ? Filters::off : Filters::on;
            return {trace(trial.tracer, filters).statistics.milliseconds, {}};
        }
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
void remove_points(BenchTrial& trial, const std::vector<bool>& lost) {
    std::vector<BenchPoint>& points = trial.work.run.points;
    for (std::size_t i = lost.size(); i-- > 0;)
        if (lost[i]) points.erase(points.begin() + static_cast<std::ptrdiff_t>(trial.first + i));
}

void measure(BenchTrial& trial) {
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
                 lose(trial, trial.techniques[i]->name, run.points[trial.first + i].settings,
                      error);
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
                     fmt::format("{}: {} of {} points done, sample {} of {} {}; at most {:.0f} s "
                                 "for the scene",
                                 trial.name, done, samples.size(), samples[i].size() + 1,
                                 point.technique, words_of(point.settings),
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

/// What the report of the pictures tells of the scene, whose truth lies in it.
void describe(SceneResult& result, const BenchTrial& trial) {
    result.argument = trial.argument;
    result.name = trial.name;
    describe(result, trial.scene);
    result.left_out = trial.plan.left_out;
    result.bump_lit = is_bump_lit(trial.scene);
    if (result.bump_lit)
        result.color = shade(trial.tracer, trial.truth, trial.traced.lights_before());
    if (filter_bumps(techniques_for(trial), trial.scene))
        result.mean_color = trial.traced.pixel_means().color;
}

void print_points(const BenchWork& work, const std::string& scene) {
    for (const std::string& line : bench_table(work.run, scene)) work.console.line(line);
    for (const BenchLeftOut& out : work.run.left_out)
        if (out.scene == scene)
            work.console.line(fmt::format("  left out: {} {}: {}", out.technique,
                                          words_of(out.settings), out.why));
}

} // namespace

bool measure_scene(const BenchWork& work, const std::string& argument) {
    const BenchOptions& options = work.options;
    work.console.progress(argument + ": reading");
    const Scene scene = work.pieces.step(
        argument + ": reading", [&] { return load_scene(argument, options.scene.request()); });
    require_scene(options.scene.memory, scene, Workload::comparison);
    BenchScene described = measured_scene(work.run, work.kept, scene, argument);
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
    work.console.progress(name + ": tracing");
    SceneResult result;
    std::optional<Tracer> traced;
    work.pieces.step(name + ": tracing", [&] {
        traced.emplace(scene, options.scene.threads);
        result.truth = trace(*traced);
    });
    const Tracer& tracer = *traced;
    const GroundTruth& truth = result.truth;
    BenchTrial trial{.work = work,
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
