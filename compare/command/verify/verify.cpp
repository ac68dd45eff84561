#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/outcome.h"
#include "compare/command/pieces/work_log.h"
#include "compare/command/process/stopwatch.h"
#include "compare/command/verify/run_identity.h"
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

/// What cells have cost: the bundled scenes', and those of the run that the user names.
Costs known_costs(const VerifyOptions& options, MemoryAccount& memory) {
    Costs costs;
    costs.add(bundled_costs());
    if (!options.costs.empty()) costs.add(read_results(options.costs, &memory).json);
    return costs;
}

/// The run that was cut off, and is to be gone on with; empty: none.
std::string work_cut_off(const VerifyOptions& options) {
    if (!options.resume) return {};
    return WorkLog::work_in(ReportFolder::progress_file_of(options.output.out));
}

/// Goes on with what the run before has left, if that says how far it came, and tells.
void take_up(ReportFolder& folder, const std::string& cut_off, const std::string& out,
             Console& console) {
    const auto note = [&](const char* what) {
        console.line(fmt::format("note: {}: {}", out, what));
    };
    if (folder.goes_on() && !cut_off.empty()) return note("goes on with the run that was cut off");
    if (folder.goes_on()) {
        note("begins anew: how far the run that was cut off has come is not known");
        folder.begin_anew();
    } else if (!cut_off.empty()) {
        note("begins anew: files of the run that was cut off are missing");
    }
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
    Report report = begin_report(options);
    const Costs costs = options.shard ? known_costs(options, memory) : Costs();
    const ResultsJson identity = run_identity(options, report.arguments);
    if (options.shard)
        report.shard = ReportShard{.number = options.shard->number,
                                   .of = options.shard->of,
                                   .run = {},
                                   .baseline = baseline ? outline_of(baseline->json).dump() : ""};
    const std::string process = process_identity(identity, options);
    const std::string cut_off = work_cut_off(options);
    if (!cut_off.empty()) require_same_process(options.output.out, cut_off, process);
    ReportFolder folder(options.output.out, options.resume ? CutOff::is_kept : CutOff::is_removed);
    take_up(folder, cut_off, options.output.out, console);
    WorkLog log = folder.goes_on() ? WorkLog::gone_on_with(folder.progress_file())
                                   : WorkLog::begun(folder.progress_file(), process);
    const bool resumed = folder.goes_on();
    VerifiedScenes verified = supervised(
        {.timeout = options.timeout, .console = console, .log = &log}, [&](Pieces& pieces) {
            return try_scenes(
                {options, report, baseline, costs, resumed, console, stopwatch, folder, pieces});
        });
    if (report.shard) report.shard->run = run_name(identity, verified.plan);
    report.gl = verified.gl;
    report.embree = verified.embree;
    report.scenes = std::move(verified.scenes);
    report.report_milliseconds = verified.report_milliseconds;
    console.progress("writing " + options.output.out);
    report.milliseconds = waited + stopwatch.milliseconds();
    return end_run(folder, console, report, options.gate, baseline, options.output, started);
}

/// For runs that outgrow one machine, or one sitting.
void add_part_flags(CLI::App& command, VerifyOptions& options) {
    CLI::Option* shard =
        command
            .add_option_function<std::string>(
                "--shard",
                [&](const std::string& text) {
                    options.shard = parse_shard(text);
                    if (!options.shard)
                        throw CLI::ValidationError(
                            "--shard", fmt::format("\"{}\" is not I/N with 1 <= I <= N", text));
                },
                "Only the I-th of N parts of the run, of about the same cost, for one of N "
                "machines; merge joins their reports")
            ->type_name("I/N");
    command
        .add_option("--costs", options.costs,
                    "An earlier results.json or report, by whose times shards are cut")
        ->type_name("FILE")
        ->check(not_empty())
        ->needs(shard);
    command.add_flag("--resume", options.resume,
                     "Go on where the same command was cut off, and keep what is done if this one "
                     "is cut off, too");
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
    add_part_flags(*command, *options);
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
        const WatchedWork work = [&](int watcher) { return verify(*options, waited, watcher); };
        return options->resume ? guarded_resumable(work, options->output.out)
                               : guarded(work, options->output.out);
    };
}

} // namespace shadowproof
