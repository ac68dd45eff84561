#include "compare/bench/bench_csv.h"
#include "compare/bench/bench_json.h"
#include "compare/command/bench/machine.h"
#include "compare/command/bench/measure.h"
#include "compare/command/bench/sweep.h"
#include "compare/command/commands.h"
#include "compare/command/console.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/standard_output.h"
#include "compare/memory.h"
#include "compare/output/write_file.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>

namespace shadowproof {

namespace {

/// The run before its first scene.
BenchRun begin_run(const BenchOptions& options, const Gpu& gpu) {
    BenchRun run;
    run.version = SHADOWPROOF_VERSION;
    run.gl = gpu.driver();
    run.embree = embree_version();
    run.machine = this_machine();
    run.arguments = settings(options.scene, options.technique);
    return run;
}

std::vector<std::string> scenes_to_measure(const BenchOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    std::vector<std::string> all;
    for (const BundledScene& scene : bundled_scenes()) all.emplace_back(scene.name);
    return all;
}

/// Whether all was measured. A scene that cannot be read does not end the run.
bool measure_scenes(const BenchWork& work) {
    const std::vector<std::string> scenes = scenes_to_measure(work.options);
    bool complete = true;
    const Stopwatch stopwatch;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        if (i > 0)
            work.console.progress(
                fmt::format("{} of {} scenes done, about {:.0f} s left", i, scenes.size(),
                            stopwatch.milliseconds() / 1000 / static_cast<double>(i) *
                                static_cast<double>(scenes.size() - i)));
        try {
            complete = measure_scene(work, scenes[i]) && complete;
            continue;
        } catch (const std::bad_alloc&) {
            work.run.left_out.push_back({scenes[i], {}, {}, out_of_memory});
        } catch (const Error& error) {
            work.run.left_out.push_back({scenes[i], {}, {}, error.what()});
        }
        complain(work.run.left_out.back().why);
        complete = false;
    }
    work.console.clear_progress();
    return complete;
}

bool has_unexplained(const BenchRun& run) {
    return std::any_of(run.points.begin(), run.points.end(), [](const BenchPoint& point) {
        return std::any_of(point.error.causes.begin(), point.error.causes.end(),
                           [](const auto& each) { return each.first == "unexplained"; });
    });
}

struct Outcome {
    BenchRun run;
    bool complete = true;
};

Outcome measured(const BenchOptions& options, Console& console) {
    Gpu gpu(options.technique.platform);
    Outcome outcome{begin_run(options, gpu)};
    std::optional<BenchRun> kept;
    if (options.resume) kept = kept_run(options.json, outcome.run);
    BenchKeeper keeper(options.json);
    const BenchWork work{.options = options,
                         .gpu = gpu,
                         .console = console,
                         .run = outcome.run,
                         .kept = kept ? &*kept : nullptr,
                         .keeper = keeper};
    outcome.complete = measure_scenes(work);
    outcome.run.finished = true;
    return outcome;
}

int bench(const BenchOptions& options) {
    Console console(options.quiet);
    std::vector<std::string> read = options.scenes;
    read.insert(read.end(), {options.from, options.against});
    check_apart(std::vector<std::string>{options.json, options.csv}, read);
    for (const std::string& file : {options.json, options.csv})
        if (!file.empty()) check_writable(file);
    require_picture(options.scene.memory, options.scene.size.width, options.scene.size.height,
                    Workload::comparison);
    const auto [run, complete] = measured(options, console);
    if (!options.json.empty()) write_file(options.json, results_text(bench_json(run)));
    if (!options.csv.empty()) write_file(options.csv, bench_csv(run));
    const bool unexplained = has_unexplained(run);
    if (unexplained) console.always("failed: a point has unexplained pixels");
    console.always(fmt::format("measured {} on {}, {}", counted(run.points.size(), "point"),
                               counted(run.scenes.size(), "scene"), run.gl.renderer));
    if (!complete) return exit_could_not;
    return unexplained ? exit_failed : exit_passed;
}

void add_bench_flags(CLI::App& command, BenchOptions& options) {
    command.add_option("--json", options.json, "Write the points here, as shadowproof/bench/1")
        ->type_name("FILE")
        ->check(not_empty());
    command.add_option("--csv", options.csv, "Write the points here, as CSV")
        ->type_name("FILE")
        ->check(not_empty());
    command.add_flag("--quick", options.quick,
                     "At most a minute for a scene: 256x256 pixels, fewer samples");
    command.add_option("--repeats", options.limits.repeats, "Most samples of a point (50)")
        ->type_name("N")
        ->check(CLI::Range(1, 10000));
    command
        .add_option("--seconds", options.limits.seconds,
                    "Seconds for the samples of a scene, after its points are judged (120)")
        ->type_name("S")
        ->check(CLI::Range(0.0, 1e6));
    command.add_flag("-q,--quiet", options.quiet, "Only what failed, and the end");
}

/// What --quick changes unless a flag says otherwise.
void make_quick(const CLI::App& command, BenchOptions& options) {
    const auto is_given = [&](const char* flag) { return command.get_option(flag)->count() > 0; };
    if (!is_given("--size")) options.scene.size = {256, 256};
    if (!is_given("--repeats")) options.limits.repeats = 15;
    if (!is_given("--seconds")) options.limits.seconds = 15;
}

} // namespace

Work add_bench(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("bench", "Error against run time, of all techniques and settings");
    const auto options = std::make_shared<BenchOptions>();
    command
        ->add_option("SCENE", options->scenes,
                     "Bundled names, or paths to .gltf, .glb or .md2 (all bundled scenes)")
        ->check(not_empty());
    add_technique_flags(*command, options->technique);
    add_scene_flags(*command, options->scene);
    add_bench_flags(*command, *options);
    command->final_callback([options, command] {
        options->fixed = fixed_settings(*command);
        if (options->quick) make_quick(*command, *options);
    });
    return [options] { return guarded([&] { return bench(*options); }); };
}

} // namespace shadowproof
