#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/start_gpu.h"
#include "compare/command/stress/stress_archive.h"
#include "compare/command/stress/sweep.h"
#include "compare/memory.h"
#include "compare/output/replaced_folder.h"
#include "compare/output/write_file.h"
#include "compare/stress/stress_json.h"
#include "compare/stress/stress_page.h"
#include "compare/words.h"
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

std::vector<std::string> scenes_to_stress(const StressOptions& options) {
    if (!options.scenes.empty()) return options.scenes;
    std::vector<std::string> all;
    for (const BundledScene& scene : bundled_scenes()) all.emplace_back(scene.name);
    return all;
}

StressRun begin_run(const StressOptions& options, const Gpu& gpu) {
    StressRun run;
    run.version = SHADOWPROOF_VERSION;
    run.gl = gpu.driver();
    run.embree = embree_version();
    run.arguments = settings(options.scene, options.technique);
    return run;
}

Report report_of(const StressRun& run) {
    Report report;
    report.version = run.version;
    report.gl = run.gl;
    report.embree = run.embree;
    report.arguments = run.arguments;
    return report;
}

/// A scene that cannot be read, or is lost while it is, does not end the run.
StressScene scene_or_error(const StressWork& work, const std::string& argument) {
    StressScene scene{.name = std::filesystem::path(argument).stem().string(), .file = argument};
    try {
        return work.pieces.piece(argument, [&] { return stress_scene(work, argument); });
    } catch (const std::bad_alloc&) {
        scene.error = out_of_memory;
    } catch (const Error& error) {
        scene.error = error.what();
    }
    if (!work.pieces.catching_up()) complain(scene.error);
    return scene;
}

/// The work of a worker.
StressRun stress_scenes(const StressOptions& options, Console& console, PointPictures& pictures,
                        Pieces& pieces) {
    const std::unique_ptr<Gpu> gpu = start_gpu(pieces, options.technique.platform);
    StressRun run = begin_run(options, *gpu);
    pictures.send_by([&](std::string bytes) { pieces.aside(std::move(bytes)); });
    StressWork work{.options = options,
                    .gpu = *gpu,
                    .console = console,
                    .pieces = pieces,
                    .run = run,
                    .pictures = options.pictures ? &pictures : nullptr};
    const std::vector<std::string> scenes = scenes_to_stress(options);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        if (scenes.size() > 1)
            work.console.begin_part(fmt::format("scene {} of {}: ", i + 1, scenes.size()));
        run.scenes.push_back(scene_or_error(work, scenes[i]));
    }
    work.console.begin_part("");
    return run;
}

void write_outputs(ReplacedFolder& folder, const StressOptions& options, const StressRun& run) {
    const std::string text = results_text(stress_json(run));
    if (!options.json.empty()) {
        const std::optional<std::string> inside = name_in_report(options.json, options.out);
        if (!inside)
            write_file(options.json, text);
        else if (*inside != results_name)
            folder.add_requested(*inside, text);
    }
    folder.add(page_name, stress_page());
    folder.add(results_name, text);
    folder.add(results_script_name, stress_script(text));
    folder.finish();
}

void check_files(const StressOptions& options) {
    check_apart(std::vector<std::string>{options.json}, options.scenes);
    check_output(options.json, options.out, Output::results);
    if (const auto name = name_in_report(options.json, options.out);
        name && std::filesystem::path(*name).begin()->string() == pictures_folder)
        throw Error(options.json, "lies in the folder of the points' pictures",
                    "name another file");
    require_picture(options.scene.memory, options.scene.size.width, options.scene.size.height,
                    Workload::comparison);
}

/// How much was lost.
struct Losses {
    std::size_t points = 0;    ///< by a crash or by taking too long: there is no truth
    std::size_t crashed = 0;   ///< cells
    std::size_t timed_out = 0; ///< cells
};

Losses losses_of(const StressRun& run) {
    Losses losses;
    for (const StressScene& scene : run.scenes)
        for (const StressAlong& along : scene.parameters)
            for (const StressPoint& point : along.points) {
                losses.points += point.loss != Loss::none ? 1 : 0;
                for (const StressCell& cell : point.cells) {
                    losses.crashed += cell.loss == Loss::crashed ? 1 : 0;
                    losses.timed_out += cell.loss == Loss::timed_out ? 1 : 0;
                }
            }
    return losses;
}

/// Prints the outcome of the run, and returns the exit code.
int conclude(const StressOptions& options, const StressRun& run, Console& console) {
    const StressTally tally = tally_of(run);
    for (const StressScene& scene : run.scenes)
        for (const StressAlong& along : scene.parameters)
            for (const StressPoint& point : along.points) {
                const auto fail = [&](const std::string& words) {
                    console.always(fmt::format("failed: {}, {}={}: {}", scene.name, along.parameter,
                                               point.value, words));
                };
                if (point.witness.disagreements > 0) fail(words_of(point.witness));
                if (point.relations.changed > 0) fail(words_of(point.relations));
                if (point.loss != Loss::none) fail(point.refused);
                for (const StressCell& cell : point.cells)
                    if (cell.loss != Loss::none) fail(cell.refused);
            }
    if (tally.unexplained > 0)
        console.always(
            fmt::format("failed: {} with unexplained pixels", counted(tally.unexplained, "cell")));
    console.always(
        fmt::format("judged {} at {}; truth and witness differ at {} of {}; the scene told "
                    "otherwise {} changes {}; page in {}",
                    counted(tally.cells, "cell"), counted(tally.points, "point"),
                    grouped(tally.disagreements), counted(tally.asked, "pixel"),
                    counted(tally.relations_tried, "time"), counted(tally.changed, "pixel"),
                    (std::filesystem::path(options.out) / page_name).string()));
    const bool unread = std::ranges::any_of(
        run.scenes, [](const StressScene& scene) { return !scene.error.empty(); });
    const Losses losses = losses_of(run);
    if (unread || losses.points + losses.crashed > 0 || tally.disagreements > 0 ||
        tally.changed > 0)
        return exit_could_not;
    return tally.unexplained + losses.timed_out > 0 ? exit_failed : exit_passed;
}

int stress(const StressOptions& options, int watcher) {
    Console console(options.quiet, watcher);
    if (const std::string note = unheeded_settings(options.technique); !note.empty())
        console.line("note: " + note);
    check_files(options);
    std::vector<std::string> fixed{page_name, results_name, results_script_name};
    if (options.pictures)
        for (const std::string& name : fixed_pictures()) fixed.push_back(name);
    ReplacedFolder folder(options.out, fixed);
    PointPictures pictures(folder);
    const StressRun run = supervised(
        {.timeout = options.timeout,
         .console = console,
         .keep = [&](const auto& bytes) { pictures.keep(bytes); }},
        [&](Pieces& pieces) { return stress_scenes(options, console, pictures, pieces); });
    console.progress("writing " + options.out);
    pictures.finish(report_of(run));
    write_outputs(folder, options, run);
    console.clear_progress();
    for (const std::string& note : folder.notes()) console.always(note);
    return conclude(options, run, console);
}

std::string parse_parameter(const std::string& name) {
    if (find_parameter(name) != nullptr) return name;
    std::string names;
    for (const StressParameter& each : stress_parameters())
        names += (names.empty() ? "" : ", ") + std::string(each.name);
    throw CLI::ValidationError(
        "--parameter", fmt::format("there is no parameter '{}'; there are {}", name, names));
}

void add_stress_flags(CLI::App& command, StressOptions& options) {
    command
        .add_option_function<std::vector<std::string>>(
            "--parameter",
            [&](const std::vector<std::string>& names) {
                options.parameters.clear();
                for (const std::string& name : names)
                    options.parameters.push_back(parse_parameter(name));
            },
            "Parameters, separated by commas (all that suit the scene)")
        ->delimiter(',')
        ->allow_extra_args(false) // a scene may follow
        ->type_name("PARAMETER");
    command
        .add_option("--witness", options.witness,
                    "Pixels of each point that a second exact tracer decides again (64)")
        ->type_name("N")
        ->check(CLI::Range(0, 1 << 28));
    command.add_option("--out", options.out, "Folder of the page (report)")
        ->type_name("DIR")
        ->check(not_empty());
    command.add_option("--json", options.json, "Write the points here, as shadowproof/stress/1")
        ->type_name("FILE")
        ->check(not_empty());
    add_timeout_flag(
        command, options.timeout,
        "Seconds for a technique at a point, and for reading or tracing a scene, above "
        "which it is given up (600; 0: any number)");
    command.add_flag_callback(
        "--no-pictures", [&options] { options.pictures = false; },
        "Keep no pictures of the points beside the page");
    command.add_flag("-q,--quiet", options.quiet, "Only what failed, and the end");
}

} // namespace

Work add_stress(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "stress", "Where each technique starts to fail as a scene becomes extreme");
    const auto options = std::make_shared<StressOptions>();
    options->scene.size = {160, 160};
    add_scenes_argument(*command, options->scenes);
    add_technique_flags(*command, options->technique);
    add_scene_flags(*command, options->scene);
    add_stress_flags(*command, *options);
    return [options] {
        return guarded([&](int watcher) { return stress(*options, watcher); }, options->out);
    };
}

} // namespace shadowproof
