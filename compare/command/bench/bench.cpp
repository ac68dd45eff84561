#include "compare/bench/against.h"
#include "compare/bench/bench_csv.h"
#include "compare/bench/bench_file.h"
#include "compare/bench/bench_json.h"
#include "compare/bench/bench_page.h"
#include "compare/bench/bench_table.h"
#include "compare/bench/kept.h"
#include "compare/command/bench/machine.h"
#include "compare/command/bench/measure.h"
#include "compare/command/bench/measured_archive.h"
#include "compare/command/bench/pictures.h"
#include "compare/command/bench/scaling.h"
#include "compare/command/bench/sweep.h"
#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/place_in_run.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/rebuild.h"
#include "compare/command/start_gpu.h"
#include "compare/memory.h"
#include "compare/output/replaced_folder.h"
#include "compare/output/write_file.h"
#include "reference/trace/trace.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
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
    if (options.scaling) run.arguments.emplace_back("--scaling");
    return run;
}

std::vector<std::string> scenes_to_measure(const BenchOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    std::vector<std::string> all;
    for (const BundledScene& scene : bundled_scenes()) all.emplace_back(scene.name);
    return all;
}

/// The last elements, from the given number on.
template <class T>
std::vector<T> tail(const std::vector<T>& all, std::size_t from) {
    return {all.begin() + static_cast<std::ptrdiff_t>(from), all.end()};
}

/// Replaces the last elements, from the given number on.
template <class T>
void put(std::vector<T>& all, std::size_t from, const std::vector<T>& last) {
    all.resize(from);
    all.insert(all.end(), last.begin(), last.end());
}

/// Measures a scene as a piece, and adds it to the run. Returns whether all was measured.
bool measure_as_piece(const BenchWork& work, const std::string& argument) {
    BenchRun& run = work.run;
    const std::size_t scenes = run.scenes.size();
    const std::size_t points = run.points.size();
    const std::size_t left_out = run.left_out.size();
    const MeasuredPart part = work.pieces.piece(argument, [&] {
        MeasuredPart measured;
        measured.complete = measure_scene(work, argument);
        measured.run.scenes = tail(run.scenes, scenes);
        measured.run.points = tail(run.points, points);
        measured.run.left_out = tail(run.left_out, left_out);
        return measured;
    });
    put(run.scenes, scenes, part.run.scenes);
    put(run.points, points, part.run.points);
    put(run.left_out, left_out, part.run.left_out);
    return part.complete;
}

/// Whether all was measured. A scene that cannot be read, or is lost, does not end the run.
bool measure_scenes(BenchWork work) {
    const std::vector<std::string> scenes = scenes_to_measure(work.options);
    bool complete = true;
    const Stopwatch stopwatch;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        work.console.begin_part(place_in_run(i, scenes.size(), stopwatch.milliseconds() / 1000));
        try {
            complete = measure_as_piece(work, scenes[i]) && complete;
            continue;
        } catch (const std::bad_alloc&) {
            work.run.left_out.push_back({scenes[i], {}, {}, out_of_memory});
        } catch (const LostPiece& lost) {
            work.run.left_out.push_back({scenes[i], {}, {}, lost.what(), lost.loss});
        } catch (const Error& error) {
            work.run.left_out.push_back({scenes[i], {}, {}, error.what()});
        }
        if (!work.pieces.catching_up()) complain(work.run.left_out.back().why);
        std::erase_if(work.run.points,
                      [](const BenchPoint& point) { return point.samples.empty(); });
        complete = false;
    }
    work.console.begin_part("");
    return complete;
}

/// The tables of a run that was not measured now.
void print_run(const BenchRun& run, Console& console) {
    for (const BenchScene& scene : run.scenes) {
        console.heading(scene.name);
        for (const std::string& line : bench_table(run, scene.name)) console.line(line);
    }
    for (const std::string& line : growth_table(run)) console.line(line);
}

/// Says what was lost. Returns whether anything was given up after --timeout.
bool say_losses(const BenchRun& run, Console& console) {
    bool timed_out = false;
    for (const BenchLeftOut& out : run.left_out) {
        if (out.loss == Loss::none) continue;
        timed_out = timed_out || out.loss == Loss::timed_out;
        console.always(fmt::format("failed: {}: {}", out.scene, out.why));
    }
    return timed_out;
}

bool has_unexplained(const BenchRun& run) {
    return std::any_of(run.points.begin(), run.points.end(), [](const BenchPoint& point) {
        return std::any_of(point.error.causes.begin(), point.error.causes.end(),
                           [](const auto& each) { return each.first == "unexplained"; });
    });
}

/// The work of a worker. `kept`: an earlier run to go on with.
MeasuredPart measure(const BenchOptions& options, const std::optional<BenchRun>& kept,
                     Console& console, PointPictures& pictures, Pieces& pieces) {
    const std::unique_ptr<Gpu> gpu = start_gpu(pieces, options.technique.platform);
    gpu->tell_stages(!options.scaling);
    gpu->time_frames(3);
    MeasuredPart outcome{.run = begin_run(options, *gpu)};
    if (kept) require_same_settings(options.json, *kept, outcome.run);
    const bool in_folder = name_in_report(options.json, options.out).has_value();
    BenchKeeper keeper(in_folder ? std::string() : options.json, kept ? &*kept : nullptr);
    pictures.send_by([&](std::string bytes) { pieces.aside(std::move(bytes)); });
    const BenchWork work{.options = options,
                         .gpu = *gpu,
                         .console = console,
                         .pieces = pieces,
                         .run = outcome.run,
                         .kept = kept ? &*kept : nullptr,
                         .keeper = keeper,
                         .pictures = options.pictures ? &pictures : nullptr};
    outcome.complete = options.scaling ? measure_growth(work) : measure_scenes(work);
    outcome.run.finished = true;
    return outcome;
}

MeasuredPart measured(const BenchOptions& options, MemoryAccount& memory, Console& console,
                      const ReplacedFolder& folder) {
    // Workers overwrite the file.
    std::optional<BenchRun> kept;
    if (options.resume) kept = kept_run(options.json, memory);
    PointPictures pictures(folder);
    MeasuredPart outcome = supervised(
        {.timeout = options.timeout,
         .console = console,
         .keep = [&](const std::string& bytes) { pictures.keep(bytes); }},
        [&](Pieces& pieces) { return measure(options, kept, console, pictures, pieces); });
    if (kept) outcome.run = with_kept(std::move(outcome.run), *kept);
    Report report;
    report.version = outcome.run.version;
    report.gl = outcome.run.gl;
    report.embree = outcome.run.embree;
    report.arguments = outcome.run.arguments;
    pictures.finish(std::move(report));
    return outcome;
}

/// Measures, or takes over what was measured.
MeasuredPart outcome_of(const BenchOptions& options, MemoryAccount& memory, Console& console,
                        const ReplacedFolder& folder) {
    if (options.from.empty()) return measured(options, memory, console, folder);
    MeasuredPart outcome{.run = read_bench(options.from, &memory)};
    refuse_to_lose(std::filesystem::is_directory(options.from)
                       ? std::filesystem::path(options.from) / results_name
                       : std::filesystem::path(options.from),
                   options.out);
    take_over_pictures(options.from, memory, outcome.run, folder, options.pictures);
    print_run(outcome.run, console);
    return outcome;
}

/// What cannot be read or written is refused before the work.
void check_files(const BenchOptions& options) {
    std::vector<std::string> read = options.scenes;
    read.insert(read.end(), {options.from, options.against});
    check_apart(std::vector<std::string>{options.json, options.csv}, read);
    check_output(options.json, options.out, Output::results);
    check_output(options.csv, options.out, Output::other);
    for (const std::string& file : {options.json, options.csv})
        if (const auto name = name_in_report(file, options.out);
            name && std::filesystem::path(*name).begin()->string() == pictures_folder)
            throw Error(file, "lies in the folder of the plot's pictures", "name another file");
    if (options.resume && name_in_report(options.json, options.out))
        throw Error(options.json, "lies in the folder of the plot, which is written at the end",
                    "name a file elsewhere with --json");
    require_picture(options.scene.memory, options.scene.size.width, options.scene.size.height,
                    Workload::comparison);
}

/// Writes a file beside the plot, or in its folder.
void write_beside(ReplacedFolder& folder, const BenchOptions& options, const std::string& file,
                  const std::string& text) {
    if (file.empty()) return;
    const std::optional<std::string> inside = name_in_report(file, options.out);
    if (!inside) return write_file(file, text);
    if (*inside != results_name) folder.add_requested(*inside, text);
}

void write_outputs(ReplacedFolder& folder, const BenchOptions& options, const BenchRun& run,
                   const std::optional<BenchRun>& older) {
    const std::string text = results_text(bench_json(run));
    write_beside(folder, options, options.json, text);
    write_beside(folder, options, options.csv, bench_csv(run));
    folder.add(page_name, bench_page());
    folder.add(results_name, text);
    folder.add(results_script_name,
               bench_script(text, older ? results_text(bench_json(*older)) : std::string()));
    folder.finish();
}

/// Whether nothing was lost.
bool print_changes(const BenchRun& older, const BenchRun& run, Console& console) {
    const BenchChanges changes = changes_between(older, run);
    for (const std::string& note : changes.notes) console.line("note: " + note);
    for (const std::string& order : changes.orders) console.line("order: " + order);
    for (const std::string& gain : changes.gains) console.line("gain: " + gain);
    for (const std::string& loss : changes.losses) console.always("loss: " + loss);
    console.always(fmt::format("compared {}: {} lost, {} gained",
                               counted(changes.compared, "point"), changes.losses.size(),
                               changes.gains.size()));
    return changes.losses.empty();
}

/// "20 points on 1 scene", "18 lines of growth"
std::string extent_of(const BenchRun& run) {
    std::string words;
    if (!run.points.empty() || run.growth.empty())
        words = fmt::format("{} on {}", counted(run.points.size(), "point"),
                            counted(run.scenes.size(), "scene"));
    if (!run.growth.empty())
        words += fmt::format("{}growth of {}", words.empty() ? "" : ", and ",
                             counted(run.growth.size(), "line"));
    return words;
}

int bench(const BenchOptions& options, int watcher) {
    Console console(options.quiet, watcher);
    if (const std::string note = unheeded_settings(options.technique); !note.empty())
        console.line("note: " + note);
    check_files(options);
    MemoryAccount memory(options.scene.memory);
    std::optional<BenchRun> older;
    if (!options.against.empty()) older = read_bench(options.against, &memory);
    std::vector<std::string> fixed{page_name, results_name, results_script_name};
    if (options.pictures && !options.scaling) {
        const std::vector<std::string> pictures = fixed_pictures();
        fixed.insert(fixed.end(), pictures.begin(), pictures.end());
    }
    ReplacedFolder folder(options.out, fixed);
    const auto [run, complete] = outcome_of(options, memory, console, folder);
    console.progress("writing " + options.out);
    write_outputs(folder, options, run, older);
    console.clear_progress();
    for (const std::string& note : folder.notes()) console.always(note);
    const bool nothing_lost = !older || print_changes(*older, run, console);
    const bool timed_out = options.from.empty() && say_losses(run, console);
    const bool unexplained = has_unexplained(run);
    if (unexplained) console.always("failed: a point has unexplained pixels");
    console.always(fmt::format(
        "{} {}, {}; plot in {}", options.from.empty() ? "measured" : "took over", extent_of(run),
        run.gl.renderer, (std::filesystem::path(options.out) / page_name).string()));
    if (!complete) return exit_could_not;
    return unexplained || timed_out || !nothing_lost ? exit_failed : exit_passed;
}

void add_bench_flags(CLI::App& command, BenchOptions& options) {
    command.add_option("--out", options.out, "Folder of the plot (report)")
        ->type_name("DIR")
        ->check(not_empty());
    CLI::Option* json =
        command.add_option("--json", options.json, "Write the points here, as shadowproof/bench/1")
            ->type_name("FILE")
            ->check(not_empty());
    command.add_option("--csv", options.csv, "Write the points here, as CSV")
        ->type_name("FILE")
        ->check(not_empty());
    command
        .add_option("--against", options.against,
                    "An earlier run: show it in the plot, and fail where a point became slower "
                    "beyond both intervals, or more wrong")
        ->type_name("FILE")
        ->check(not_empty());
    command
        .add_option("--from", options.from,
                    "Measure nothing: take over what bench --json wrote, or the folder of a plot")
        ->type_name("FILE")
        ->check(not_empty());
    command
        .add_flag("--resume", options.resume, "Go on with the run that was stopped, from --json")
        ->needs(json);
    command.add_flag("--scaling", options.scaling,
                     "Instead: how time grows with pixels and texels (of the first SCENE), "
                     "triangles, volumes crossed, silhouette edges, and lights");
    command.add_flag("--quick", options.quick,
                     "At most a minute for a scene: 256x256 pixels, fewer samples, no map of 8192 "
                     "texels a side");
    command.add_option("--repeats", options.limits.repeats, "Most samples of a point (50)")
        ->type_name("N")
        ->check(CLI::Range(1, 10000));
    command
        .add_option("--seconds", options.limits.seconds,
                    "Seconds for the samples of a scene, after its points are judged (120)")
        ->type_name("S")
        ->check(CLI::Range(0.0, 1e6));
    add_timeout_flag(command, options.timeout,
                     "Seconds for judging a point, for a sample of it, and for reading or tracing "
                     "a scene, above which it is given up (600; 0: any number)");
    command.add_flag_callback(
        "--no-pictures", [&options] { options.pictures = false; },
        "Keep no pictures of the points beside the plot");
    command.add_flag("-q,--quiet", options.quiet, "Only what failed, and the end");
}

/// What --quick changes unless a flag says otherwise.
void make_quick(const CLI::App& command, BenchOptions& options) {
    const auto is_given = [&](const char* flag) { return command.get_option(flag)->count() > 0; };
    if (!is_given("--size")) options.scene.size = {256, 256};
    if (!is_given("--repeats")) options.limits.repeats = 15;
    if (is_given("--seconds")) return;
    // Of the minute that it may take, some are left for the pictures and the last samples.
    options.limits.seconds = 50;
    options.scene_seconds = 50;
}

} // namespace

Work add_bench(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("bench", "Error against run time, of all techniques and settings");
    const auto options = std::make_shared<BenchOptions>();
    add_scenes_argument(*command, options->scenes);
    add_technique_flags(*command, options->technique);
    add_scene_flags(*command, options->scene);
    add_bench_flags(*command, *options);
    command->final_callback([options, command] {
        options->fixed = fixed_settings(*command);
        if (!options->from.empty() && (!options->scenes.empty() || options->resume))
            throw CLI::ValidationError("--from", "measures nothing; leave out the scenes and "
                                                 "--resume, or leave out --from");
        if (options->quick) make_quick(*command, *options);
    });
    return [options] {
        return guarded([&](int watcher) { return bench(*options, watcher); }, options->out);
    };
}

} // namespace shadowproof
