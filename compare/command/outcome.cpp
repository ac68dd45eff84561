#include "compare/command/outcome.h"

#include "compare/command/options.h"
#include "compare/command/output_files.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/standard_output.h"
#include "compare/command/worst_cells.h"
#include "compare/output/write_file.h"
#include "raster/technique.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

namespace fs = std::filesystem;

int exit_code(const Report& report) {
    for (const SceneResult& scene : report.scenes)
        if (!scene.error.empty() ||
            std::any_of(scene.cells.begin(), scene.cells.end(),
                        [](const Cell& cell) { return could_not_run(cell); }))
            return exit_could_not;
    return report.passed ? exit_passed : exit_failed;
}

/// Each step appends to the same file.
void append_step_summary(const Report& report) {
    const char* file = std::getenv("GITHUB_STEP_SUMMARY");
    if (file == nullptr || *file == '\0') return;
    try {
        append_to_file(file, to_step_summary(report));
    } catch (const Error& error) {
        // The console has the same content: a lost summary fails no build.
        complain(fmt::format("GITHUB_STEP_SUMMARY={}", error.what()));
    }
}

void conclude_worst(Console& console, const Report& report) {
    const std::vector<std::string> lines = worst_cells(report);
    if (!lines.empty()) console.heading("worst cells first:");
    for (const std::string& line : lines) console.line("  " + line);
}

void conclude_reproducing(Console& console, const Report& report) {
    for (const SceneResult& scene : report.scenes) {
        for (const Cell& cell : scene.cells)
            if (fails(cell, report.gate))
                console.always("reproduce: " + reproducing_command(report, scene, cell));
        if (!scene.no_longer_provoked.empty())
            console.always("reproduce: " + reproducing_command(report, scene));
    }
}

std::string outcome_words(const Report& report) {
    std::uint64_t cells = 0;
    std::uint64_t failing = 0;
    std::uint64_t unread = 0;
    std::uint64_t unprovoked = 0;
    for (const SceneResult& scene : report.scenes) {
        cells += scene.cells.size();
        for (const Cell& cell : scene.cells) failing += fails(cell, report.gate) ? 1 : 0;
        unread += scene.error.empty() ? 0 : 1;
        unprovoked += scene.no_longer_provoked.empty() ? 0 : 1;
    }
    std::string words =
        report.passed ? "passed: " + counted(cells, "cell")
                      : fmt::format("failed: {} of {}", grouped(failing), counted(cells, "cell"));
    if (report.shard)
        words += fmt::format(" of part {} of {}", report.shard->number, report.shard->of);
    if (unread > 0) words += fmt::format(", {} that could not be tried", counted(unread, "scene"));
    if (unprovoked > 0)
        words += fmt::format(", {} that stopped provoking", counted(unprovoked, "scene"));
    return words;
}

} // namespace

std::string timestamp_now() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(now));
}

void check_outputs(const OutputOptions& options, std::span<const std::string> read) {
    check_output(options.json, options.out, Output::results);
    check_output(options.junit, options.out, Output::other);
    check_apart(std::array{options.json, options.junit, options.out}, read);
}

void finish(ReportFolder& folder, Console& console, Report& report, const OutputOptions& options,
            const std::string& started) {
    const std::optional<std::string> json = name_in_report(options.json, options.out);
    if (json && *json != results_name) folder.add_requested(*json, to_json(report));
    if (const std::optional<std::string> junit = name_in_report(options.junit, options.out))
        folder.add_requested(*junit, to_junit(report, started, options.out));
    folder.finish(report);
    for (const std::string& note : folder.notes()) console.always(note);
}

std::vector<std::string> stopped_provoking(const Report& report,
                                           std::span<const SceneResult> lights) {
    const SceneResult& scene = lights.front();
    if (!is_default_picture(report.arguments) || !is_bundled(scene.argument)) return {};
    std::vector<std::vector<Cause>> fails_at;
    CausePixels shown{};
    for (const SceneResult& light : lights)
        for (const Technique& technique : all_techniques()) {
            // Its shadows are zfail_reversed's, which is tried on every scene.
            if (technique.needs_bump_maps || !is_for(technique, light.light.kind)) continue;
            const auto cell =
                std::find_if(light.cells.begin(), light.cells.end(),
                             [&](const Cell& tried) { return tried.technique == technique.name; });
            // A technique that was not tried or could not run may be the one that shows it.
            if (cell == light.cells.end() || !cell->error.empty()) return {};
            fails_at.push_back(technique.fails_at);
            for (std::size_t cause = 0; cause < shown.size(); ++cause)
                shown[cause] += cell->comparison.causes[cause];
        }
    std::vector<Cause> provokes;
    for (const std::string& name : scene.provokes)
        if (const std::optional<Cause> cause = cause_named(name)) provokes.push_back(*cause);
    std::vector<std::string> names;
    const auto is_shown = [&](Cause cause) { return shown[static_cast<std::size_t>(cause)] > 0; };
    for (const Cause cause : no_longer_provoked(provokes, fails_at, is_shown))
        names.emplace_back(name_of(cause));
    return names;
}

bool passes(const Report& report) {
    return std::none_of(report.scenes.begin(), report.scenes.end(),
                        [&](const SceneResult& scene) { return fails(scene, report.gate); });
}

int conclude(Console& console, const Report& report, const OutputOptions& options,
             const std::string& started) {
    const auto lies_elsewhere = [&](const std::string& file) {
        return !file.empty() && !name_in_report(file, options.out);
    };
    if (lies_elsewhere(options.json)) write_file(options.json, to_json(report));
    if (lies_elsewhere(options.junit))
        write_file(options.junit, to_junit(report, started, options.out));
    if (report.baseline)
        for (const std::string& note : report.baseline->notes) console.line("baseline: " + note);
    conclude_worst(console, report);
    conclude_reproducing(console, report);
    if (console.on_github()) {
        console.commands(to_workflow_commands(report));
        append_step_summary(report);
    }
    // Set by CTest for the tests that it runs.
    if (std::getenv("DASHBOARD_TEST_FROM_CTEST") != nullptr)
        console.commands(to_ctest_measurements(report, options.out));
    console.always(fmt::format("{}; report in {}", outcome_words(report),
                               (fs::path(options.out) / "index.html").string()));
    return exit_code(report);
}

int end_run(ReportFolder& folder, Console& console, Report& report, const GateOptions& gate,
            const std::optional<ResultsFile>& baseline, const OutputOptions& output,
            const std::string& started) {
    if (baseline)
        report.baseline =
            Baseline{gate.baseline, baseline->json["passed"].get<bool>(),
                     notes_on(outline_of(baseline->json), outline_of(report), !report.shard)};
    report.passed = passes(report);
    finish(folder, console, report, output, started);
    return conclude(console, report, output, started);
}

} // namespace shadowproof
