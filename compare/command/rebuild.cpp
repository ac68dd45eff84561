#include "compare/command/rebuild.h"

#include "compare/command/guard.h"
#include "compare/command/options.h"
#include "compare/command/output_files.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/output/write_file.h"
#include "compare/results/merge.h"
#include "compare/results/results_check.h"
#include "raster/technique.h"
#include "scenes/error.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

namespace shadowproof {

namespace fs = std::filesystem;

namespace {

Matrix whole_matrix() {
    Matrix matrix;
    for (const Technique& technique : all_techniques())
        matrix.techniques.push_back(
            {std::string(technique.name), technique.fails_at, !technique.needs_bump_maps});
    for (const BundledScene& scene : bundled_scenes()) matrix.scenes.emplace_back(scene.name);
    return matrix;
}

/// Copies the files that the results name. Damaged ones do not stop the report: the viewer checks
/// them itself, and shows what is missing as missing.
void take_over_all(const std::vector<ReportFile>& files, const ReportFolder& folder,
                   const MemoryAccount& memory, Console& console) {
    constexpr std::size_t most_lines = 12; // a whole missing folder is reported once
    std::size_t damaged = 0;
    std::set<fs::path> taken; // several cells may have the same picture
    for (const ReportFile& file : files) {
        console.progress("copying " + file.to);
        const std::optional<std::string> damage = take_over(file, folder, memory);
        if (taken.insert(file.from).second && damage && ++damaged <= most_lines)
            console.always(fmt::format("damaged: {} {}", file.from.string(), *damage));
    }
    if (damaged > most_lines)
        console.always(fmt::format("damaged: {} more files", damaged - most_lines));
    if (damaged > 0)
        console.always(fmt::format("{} of {} pictures and data files are missing or damaged, and "
                                   "the report shows them so",
                                   grouped(damaged), grouped(taken.size())));
}

struct Outcome {
    std::size_t cells = 0;
    std::size_t failing = 0;
    std::size_t not_run = 0; ///< cells, of those failing
    std::size_t unread = 0;  ///< scenes
    std::size_t unprovoked = 0;
};

/// Names what fails.
Outcome count_outcome(const ResultsJson& results, Console& console) {
    Outcome outcome;
    for (const ResultsJson& scene : results.at("scenes")) {
        const std::string name = shown(scene.at("name"));
        if (could_not_run(scene)) {
            ++outcome.unread;
            console.always(fmt::format("fails: {} could not be tried", name));
            continue;
        }
        for (const ResultsJson& cell : scene.at("techniques")) {
            ++outcome.cells;
            if (cell.at("fails") != true) continue;
            ++outcome.failing;
            // A verdict beside the error: given up after the time limit.
            const bool ran = !could_not_run(cell) || cell.contains("verdict");
            if (!ran) ++outcome.not_run;
            console.always(
                fmt::format("fails: {} on {}: {}", shown(cell.at("name")), name,
                            ran ? cell.at("verdict").get<std::string>() : "could not run"));
        }
        if (scene.at("no_longer_provoked").empty()) continue;
        ++outcome.unprovoked;
        console.always(fmt::format("fails: no technique shows {} of {} any more",
                                   scene.at("no_longer_provoked").dump(), name));
    }
    return outcome;
}

int conclude(const ResultsJson& results, const std::string& out, Console& console) {
    const Outcome outcome = count_outcome(results, console);
    const bool passed = results.at("passed") == true;
    std::string text = passed ? "passed: " + counted(outcome.cells, "cell")
                              : fmt::format("failed: {} of {}", grouped(outcome.failing),
                                            counted(outcome.cells, "cell"));
    if (outcome.unread > 0)
        text += fmt::format(", {} that could not be tried", counted(outcome.unread, "scene"));
    if (outcome.unprovoked > 0)
        text += fmt::format(", {} that stopped provoking", counted(outcome.unprovoked, "scene"));
    console.always(fmt::format("{}; report in {}", text, (fs::path(out) / "index.html").string()));
    if (outcome.unread + outcome.not_run > 0) return exit_could_not;
    return passed ? exit_passed : exit_failed;
}

} // namespace

void refuse_to_lose(const fs::path& results, const fs::path& out) {
    const fs::path file = fs::weakly_canonical(results.parent_path()) / results.filename();
    const fs::path relative = file.lexically_relative(fs::weakly_canonical(out / "."));
    if (relative.empty() || *relative.begin() == ".." || relative == "results.json") return;
    throw Error(out.string(), fmt::format("holds {}, and would be replaced", results.string()),
                "name another folder with --out");
}

void add_rebuild_flags(CLI::App& command, RebuildOptions& options) {
    command.add_option("--out", options.out, "Folder of the report (report)")
        ->type_name("DIR")
        ->check(not_empty());
    add_memory_flag(command, options.memory);
    command.add_flag("-q,--quiet", options.quiet, "Only what failed, and the end");
}

namespace {

int rebuild_here(const RebuildOptions& options, int watcher) {
    Console console(options.quiet, watcher);
    MemoryAccount memory(options.memory);
    std::vector<ResultsFile> runs;
    for (const std::string& path : options.from) {
        console.progress("reading " + path);
        refuse_to_lose(runs.emplace_back(read_results(path, &memory)).path, options.out);
    }
    check_output(options.json, options.out, Output::results);
    ReportFolder folder(options.out);
    console.progress("joining the results");
    Merged merged = merge(runs, whole_matrix());
    take_over_all(merged.files, folder, memory, console);
    folder.share(merged.results);
    const std::string text = results_text(merged.results);
    const std::optional<std::string> inside = name_in_report(options.json, options.out);
    if (inside && *inside != results_name) folder.add_requested(*inside, text);
    console.progress("writing " + options.out);
    folder.finish(text);
    for (const std::string& note : folder.notes()) console.always(note);
    if (!options.json.empty() && !inside) write_file(options.json, text);
    return conclude(merged.results, options.out, console);
}

} // namespace

int rebuild(const RebuildOptions& options) {
    return guarded([&](int watcher) { return rebuild_here(options, watcher); }, options.out);
}

} // namespace shadowproof
