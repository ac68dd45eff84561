#include "compare/command/check/check_scene.h"
#include "compare/command/check/renderer.h"
#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/outcome.h"
#include "compare/command/pieces/report_archive.h"
#include "compare/command/process/place_in_run.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/scene_result.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace shadowproof {

namespace {

/// What all scenes of a run share.
struct Run {
    const CheckOptions& options;
    const std::optional<ResultsFile>& baseline;
    MemoryAccount& memory;
    Console& console;
    const ReportFolder& folder;
    std::filesystem::path rendered; ///< where the renderer writes; empty: there is none
    const std::vector<SceneResult>& done;
};

SceneResult judged_scene(const Run& run, const SceneInputs& inputs) {
    return supervised({.timeout = run.options.timeout, .console = run.console},
                      [&](Pieces& pieces) {
                          return check_scene({run.options, inputs, run.baseline, run.memory,
                                              run.console, run.folder, run.done, pieces});
                      });
}

/// A scene that cannot be tried does not end the run.
SceneResult rendered_scene(const Run& run, const std::string& scene) {
    SceneResult result;
    result.argument = scene;
    result.name = unique_name(run.done, std::filesystem::path(scene).stem().string());
    try {
        return judged_scene(run, render_scene(run.options, scene, result.name, run.rendered,
                                              run.folder, run.console));
    } catch (const OutputLost&) {
        throw;
    } catch (const std::exception& error) {
        result.error = as_in_report(error.what(), run.rendered);
        run.console.clear_progress();
        complain(result.error);
    }
    return result;
}

int check(const CheckOptions& options, const std::filesystem::path& rendered, double waited,
          int watcher) {
    const Stopwatch stopwatch;
    const std::string started = timestamp_now();
    Console console(options.output.quiet, watcher);
    MemoryAccount memory(options.view.memory);
    std::vector<std::string> inputs = options.pictures;
    inputs.insert(inputs.end(), options.scenes.begin(), options.scenes.end());
    inputs.insert(inputs.end(), {options.mask, options.unlit, options.unshadowed});
    check_outputs(options.output, inputs);
    std::optional<ResultsFile> baseline;
    if (!options.gate.baseline.empty()) baseline = read_results(options.gate.baseline, &memory);
    ReportFolder folder(options.output.out);
    Report report;
    report.version = SHADOWPROOF_VERSION;
    report.gl = {"none", "none", DepthModel{}.subpixel_bits, 0, 0};
    report.gate = options.gate.gate;
    const Run run{options, baseline, memory, console, folder, rendered, report.scenes};
    for (const std::string& scene : options.scenes) {
        console.begin_part(place_in_run(report.scenes.size(), options.scenes.size(),
                                        stopwatch.milliseconds() / 1000));
        const SceneInputs given{scene,         options.pictures,   options.mask,
                                options.unlit, options.unshadowed, {}};
        report.scenes.push_back(options.renderer.empty() ? judged_scene(run, given)
                                                         : rendered_scene(run, scene));
    }
    console.begin_part("");
    report.embree = embree_version(); // starts Embree: no worker is started any more
    console.progress("writing " + options.output.out);
    report.milliseconds = waited + stopwatch.milliseconds();
    return end_run(folder, console, report, options.gate, baseline, options.output, started);
}

void add_picture_flags(CLI::App& command, CheckOptions& options) {
    CLI::Option* mask =
        command
            .add_option("--mask", options.mask,
                        "The picture's shadows: black where shadowed, white where lit")
            ->type_name("IMAGE")
            ->check(not_empty());
    command
        .add_option("--unlit", options.unlit,
                    "The same view without the light: what differs from it is lit")
        ->type_name("IMAGE")
        ->check(not_empty())
        ->excludes(mask);
    command
        .add_option("--unshadowed", options.unshadowed,
                    "The same view with the light, but without its shadows: what is darker than it "
                    "is shadowed. With --unlit as well each pixel tells by itself what light adds, "
                    "however surfaces are shaded")
        ->type_name("IMAGE")
        ->check(not_empty())
        ->excludes(mask);
}

void add_renderer_flags(CLI::App& command, CheckOptions& options) {
    command
        .add_option_function<std::string>(
            "--renderer",
            [&options](const std::string& text) {
                try {
                    require_command(text);
                } catch (const std::invalid_argument& error) {
                    throw CLI::ValidationError("--renderer", error.what());
                }
                options.renderer = text;
            },
            "A program that makes the picture of each scene, run without a shell: {scene} is the "
            "scene's file, {view} its view as export-view prints it, {out} the .png to write, "
            "{unlit} another one without the light, {unshadowed} one without shadows")
        ->type_name("COMMAND");
    command.add_option("--name", options.name, "The renderer's name in the report (renderer)")
        ->type_name("NAME")
        ->check([](const std::string& name) {
            const bool is_plain = !name.empty() && name.front() != '.' &&
                                  name.find_first_of("/\\") == std::string::npos;
            return is_plain ? "" : "'" + name + "' is no name of a file; give one, as my_engine";
        });
}

/// Checks that involve several options, which CLI11 does not make. With a renderer all positionals
/// are scenes.
void check_together(CheckOptions& options) {
    if (options.renderer.empty()) {
        if (options.pictures.empty())
            throw CLI::RequiredError("IMAGE, or --renderer that makes one");
        if (!options.name.empty())
            throw CLI::ValidationError("--name", "is of a --renderer; pictures have the names of "
                                                 "their files");
    } else {
        if (!options.mask.empty() || !options.unlit.empty() || !options.unshadowed.empty())
            throw CLI::ValidationError(
                "--renderer", "makes its own pictures; put {unlit} where it writes the one without "
                              "the light, {unshadowed} for one without shadows, and leave --mask, "
                              "--unlit and --unshadowed out");
        if (options.view.stress)
            throw CLI::ValidationError("--stress",
                                       "changes the scene, which a --renderer reads from its file");
        if (options.name.empty()) options.name = usual_name;
        options.with_size = true;
        options.scenes.insert(options.scenes.end(), options.pictures.begin(),
                              options.pictures.end());
        options.pictures.clear();
    }
    for (const auto& [flag, file] : {std::pair("--mask", &options.mask),
                                     {"--unlit", &options.unlit},
                                     {"--unshadowed", &options.unshadowed}})
        if (!file->empty() && options.pictures.size() > 1)
            throw CLI::ValidationError(flag, "is of one picture; check the others by themselves");
}

} // namespace

Work add_check(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("check", "Pictures that a renderer made of a scene, against the truth");
    const auto options = std::make_shared<CheckOptions>();
    add_scene_argument(*command, options->scenes.emplace_back());
    command
        ->add_option(
            "IMAGE", options->pictures,
            "Pictures of that view: .png, .jpg, .exr or .hdr, all of one size; with --renderer, "
            "more scenes")
        ->check(not_empty());
    add_picture_flags(*command, *options);
    add_renderer_flags(*command, *options);
    command->add_flag_callback(
        "--no-alignment", [options] { options->alignment = false; },
        "Judge a picture even where it seems to show another view");
    command->add_flag_callback(
        "--no-diagnosis", [options] { options->diagnosis = false; },
        "Do not ask why pixels are wrong");
    command->add_flag("--controls", options->controls,
                      "Would it be caught? Makes small faults in the truth (a caster's shadow "
                      "missing, the light moved, ...), and puts them through the same check");
    add_scene_flags(*command, options->view);
    add_gate_flags(*command, options->gate);
    add_output_flags(*command, options->output);
    add_timeout_flag(*command, options->timeout,
                     "Seconds for a picture, for a run of the renderer, and for reading or tracing "
                     "the scene, above which it is given up (600; 0: any number)");
    command->final_callback([options, command] {
        options->with_size = command->get_option("--size")->count() > 0;
        check_together(*options);
    });
    return [options] {
        const double waited = milliseconds_since_start_of_process().value_or(0);
        // In this process, which outlives all others, so that it is removed in any case.
        std::optional<RenderFolder> rendered;
        if (!options->renderer.empty()) rendered.emplace();
        return guarded(
            [&](int watcher) {
                return check(*options, rendered ? rendered->path() : std::filesystem::path(),
                             waited, watcher);
            },
            options->output.out);
    };
}

} // namespace shadowproof
