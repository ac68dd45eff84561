#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/outcome.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/verify/worker.h"
#include "compare/memory.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

namespace shadowproof {

namespace {

/// The content of results.json before the first scene is tried.
Report begin_report(const VerifyOptions& options) {
    Report report;
    report.version = SHADOWPROOF_VERSION;
    report.arguments = settings(options.scene, options.technique);
    const std::vector<std::string> gate = settings(options.gate);
    report.arguments.insert(report.arguments.end(), gate.begin(), gate.end());
    if (options.timeout != VerifyOptions{}.timeout) {
        report.arguments.emplace_back("--timeout");
        report.arguments.push_back(fmt::format("{}", options.timeout));
    }
    report.gate = options.gate.gate;
    return report;
}

/// `waited`: milliseconds since the program was started.
int verify(const VerifyOptions& options, double waited, int watcher) {
    const Stopwatch stopwatch;
    const std::string started = timestamp_now();
    Console console(options.output.quiet, watcher);
    // What cannot be read or written is refused before the work.
    std::optional<ResultsFile> baseline;
    MemoryAccount memory(options.scene.memory);
    if (!options.gate.baseline.empty()) baseline = read_results(options.gate.baseline, &memory);
    check_outputs(options.output, options.scenes);
    require_picture(options.scene.memory, options.scene.size.width, options.scene.size.height,
                    Workload::comparison);
    if (const std::string note = unheeded_settings(options.technique); !note.empty())
        console.line("note: " + note);
    for (const Allowance& allowance : options.gate.gate.allow)
        if (allowance.cause == Cause::edge)
            console.line("note: --allow edge changes nothing: edge pixels never fail");
    ReportFolder folder(options.output.out);
    Report report = begin_report(options);
    VerifiedScenes verified =
        supervised({.timeout = options.timeout, .console = console}, [&](Pieces& pieces) {
            return try_scenes({options, report, baseline, console, stopwatch, folder, pieces});
        });
    report.gl = verified.gl;
    report.embree = verified.embree;
    report.scenes = std::move(verified.scenes);
    report.report_milliseconds = verified.report_milliseconds;
    console.progress("writing " + options.output.out);
    report.milliseconds = waited + stopwatch.milliseconds();
    return end_run(folder, console, report, options.gate, baseline, options.output, started);
}

} // namespace

Work add_verify(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("verify", "Every technique against the truth; a report of the pixels");
    const auto options = std::make_shared<VerifyOptions>();
    add_scenes_argument(*command, options->scenes);
    add_technique_flags(*command, options->technique);
    add_scene_flags(*command, options->scene);
    add_gate_flags(*command, options->gate);
    add_output_flags(*command, options->output);
    command
        ->add_option("--witness", options->witness,
                     "Pixels that a second exact tracer, slow and simple, decides again; where it "
                     "differs the scene could not run (0)")
        ->type_name("N")
        ->check(CLI::Range(0, 1 << 28));
    add_timeout_flag(*command, options->timeout,
                     "Seconds for a cell, and for reading or tracing a scene, above which it is "
                     "given up (600; 0: any number)");
    return [options] {
        const double waited = milliseconds_since_start_of_process().value_or(0);
        return guarded([&](int watcher) { return verify(*options, waited, watcher); },
                       options->output.out);
    };
}

} // namespace shadowproof
