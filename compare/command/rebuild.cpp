#include "compare/command/rebuild.h"

#include "compare/command/guard.h"
#include "compare/command/options.h"
#include "compare/command/output_files.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/output/descriptor.h"
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
    for (const Technique& technique : all_techniques()) {
        KnownTechnique& known = matrix.techniques.emplace_back(KnownTechnique{
            std::string(technique.name), technique.fails_at, !technique.needs_bump_maps});
        for (const Light::Kind kind : technique.lights) known.lights.emplace_back(name_of(kind));
    }
    for (const BundledScene& scene : bundled_scenes()) matrix.scenes.emplace_back(scene.name);
    return matrix;
}

/// Copies the files that results name. Damaged ones do not stop the report: the viewer checks them
/// itself, and shows what is missing as missing.
class TakeOver {
public:
    TakeOver(const ReportFolder& folder, const MemoryAccount& memory, Console& console)
        : folder_(folder), memory_(memory), console_(console) {}

    void scene(const std::vector<ReportFile>& files) {
        std::set<fs::path> taken; // several cells may have the same picture
        for (const ReportFile& file : files) {
            console_.progress("copying " + file.to);
            const std::optional<std::string> damage = take_over(file, folder_, memory_);
            if (taken.insert(file.from).second && damage && ++damaged_ <= most_lines)
                console_.always(fmt::format("damaged: {} {}", file.from.string(), *damage));
        }
        taken_ += taken.size();
    }

    void conclude() const {
        if (damaged_ > most_lines)
            console_.always(fmt::format("damaged: {} more files", damaged_ - most_lines));
        if (damaged_ > 0)
            console_.always(
                fmt::format("{} of {} pictures and data files are missing or damaged, and the "
                            "report shows them so",
                            grouped(damaged_), grouped(taken_)));
    }

private:
    static constexpr std::size_t most_lines = 12; // a whole missing folder is reported once

    const ReportFolder& folder_;
    const MemoryAccount& memory_;
    Console& console_;
    std::size_t damaged_ = 0;
    std::size_t taken_ = 0;
};

struct Outcome {
    std::size_t cells = 0;
    std::size_t failing = 0;
    std::size_t not_run = 0; ///< cells, of those failing
    std::size_t unread = 0;  ///< scenes
    std::size_t unprovoked = 0;
};

/// Names what fails.
Outcome count_outcome(const Merged& results, Console& console) {
    Outcome outcome;
    for (const MergedScene& scene : results.scenes) {
        const std::string name = shown(scene.head.at("name"));
        if (could_not_run(scene.head)) {
            ++outcome.unread;
            console.always(fmt::format("fails: {} could not be tried", name));
            continue;
        }
        for (const MergedCell& cell : scene.cells) {
            const IndexedCell& what = cell.what;
            ++outcome.cells;
            if (!what.fails) continue;
            ++outcome.failing;
            // A verdict beside the error: given up after the time limit.
            const bool ran = !what.could_not_run || !what.verdict.empty();
            if (!ran) ++outcome.not_run;
            console.always(fmt::format("fails: {} on {}: {}", shown(what.name), name,
                                       ran ? what.verdict : "could not run"));
        }
        const ResultsJson& stopped = scene.head.at("no_longer_provoked");
        if (stopped.empty()) continue;
        ++outcome.unprovoked;
        console.always(
            fmt::format("fails: no technique shows {} of {} any more", stopped.dump(), name));
    }
    return outcome;
}

int conclude(const Merged& results, const std::string& out, Console& console) {
    const Outcome outcome = count_outcome(results, console);
    const bool passed = results.head.at("passed") == true;
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
    std::vector<IndexedResults> runs;
    for (const std::string& path : options.from) {
        console.progress("reading " + path);
        refuse_to_lose(runs.emplace_back(index_results(path, memory)).path, options.out);
    }
    check_output(options.json, options.out, Output::results);
    const bool inside_out = name_in_report(options.json, options.out).has_value();
    for (const IndexedResults& run : runs)
        if (!inside_out && name_in_report(options.json, run.path.parent_path().string()))
            throw Error(options.json, "lies in a report that is read, and may be one of its files",
                        "name a file elsewhere");
    ReportFolder folder(options.out);
    console.progress("joining the results");
    const Merged merged =
        options.what == Rebuilt::one_run ? alone(runs.front()) : merge(runs, whole_matrix());
    const std::optional<std::string> inside = name_in_report(options.json, options.out);
    GrowingResults results =
        folder.grow_results(merged.head, inside && *inside != results_name ? inside : std::nullopt);
    TakeOver files(folder, memory, console);
    for (std::size_t i = 0; i < merged.scenes.size(); ++i) {
        const WholeScene scene = whole_scene(merged, i, runs);
        files.scene(scene.files);
        results.add(scene.json);
    }
    results.end();
    files.conclude();
    console.progress("writing " + options.out);
    folder.finish();
    for (const std::string& note : folder.notes()) console.always(note);
    if (!options.json.empty() && !inside)
        write_file(options.json, [&](const TakesBytes& take) {
            read_pieces(fs::canonical(fs::path(options.out) / results_name), take);
        });
    return conclude(merged, options.out, console);
}

} // namespace

int rebuild(const RebuildOptions& options) {
    return guarded([&](int watcher) { return rebuild_here(options, watcher); }, options.out);
}

} // namespace shadowproof
