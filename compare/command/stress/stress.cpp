#include "compare/command/commands.h"
#include "compare/command/console.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/standard_output.h"
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

/// A scene that cannot be read does not end the run.
void stress_scenes(StressWork work) {
    const std::vector<std::string> scenes = scenes_to_stress(work.options);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        if (scenes.size() > 1) work.place = fmt::format("scene {} of {}: ", i + 1, scenes.size());
        std::string error;
        try {
            stress_scene(work, scenes[i]);
            continue;
        } catch (const std::bad_alloc&) {
            error = out_of_memory;
        } catch (const Error& thrown) {
            error = thrown.what();
        }
        complain(error);
        work.run.scenes.push_back({.name = std::filesystem::path(scenes[i]).stem().string(),
                                   .file = scenes[i],
                                   .error = error});
    }
    work.console.clear_progress();
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

/// What the run comes to, said; and the exit code.
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
            }
    if (tally.unexplained > 0)
        console.always(
            fmt::format("failed: {} with unexplained pixels", counted(tally.unexplained, "cell")));
    console.always(
        fmt::format("judged {} at {}; truth and witness differ at {} of {}; the scene told "
                    "otherwise {} changes {}; page in {}",
                    counted(tally.cells, "cell"), counted(tally.points, "point"),
                    grouped(tally.disagreements), counted(tally.asked, "pixel"),
                    counted(tally.retold, "time"), counted(tally.changed, "pixel"),
                    (std::filesystem::path(options.out) / page_name).string()));
    const bool unread = std::ranges::any_of(
        run.scenes, [](const StressScene& scene) { return !scene.error.empty(); });
    if (unread || tally.disagreements > 0 || tally.changed > 0) return exit_could_not;
    return tally.unexplained > 0 ? exit_failed : exit_passed;
}

int stress(const StressOptions& options) {
    Console console(options.quiet);
    check_files(options);
    std::vector<std::string> fixed{page_name, results_name, results_script_name};
    if (options.pictures)
        for (const std::string& name : fixed_pictures()) fixed.push_back(name);
    ReplacedFolder folder(options.out, fixed);
    Gpu gpu(options.technique.platform);
    StressRun run = begin_run(options, gpu);
    PointPictures pictures(folder);
    stress_scenes({.options = options,
                   .gpu = gpu,
                   .console = console,
                   .run = run,
                   .pictures = options.pictures ? &pictures : nullptr});
    pictures.finish(report_of(run));
    write_outputs(folder, options, run);
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
        ->type_name("A,B");
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
    command.add_flag("!--no-pictures", options.pictures,
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
    return [options] { return guarded([&] { return stress(*options); }, options->out); };
}

} // namespace shadowproof
