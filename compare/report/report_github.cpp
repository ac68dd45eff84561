#include "compare/evidence.h"
#include "compare/report/escape.h"
#include "compare/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace shadowproof {

namespace {

/// A bundled scene is not a file of the user's repository, so no line of it can be annotated.
std::string file_property(const SceneResult& scene) {
    return scene.argument == scene.file
               ? "file=" + for_workflow_property(printable(scene.file)) + ","
               : "";
}

/// Control characters are removed first: a line end within a name would start a line of its own.
std::string error_line(const SceneResult& scene, const std::string& title,
                       const std::string& message, const std::string& reproduce) {
    return fmt::format("::error {}title={}::{}\n", file_property(scene),
                       for_workflow_property(printable(title)),
                       for_workflow(printable(message) + "\nreproduce: " + printable(reproduce)));
}

/// One row of the table.
struct Row {
    bool failed = false;
    std::string scene;
    std::string technique;
    std::string verdict;
    std::string pixels;
    std::string causes;
    std::string first;
};

std::string first_words(const Cell& cell) {
    const auto& first = cell.first_failing ? cell.first_failing : cell.comparison.first;
    return first ? fmt::format("({},{}) {}", first->x, first->y, name_of(first->cause)) : "";
}

Row row_of(const Report& report, const SceneResult& scene, const Cell& cell) {
    Row row{.failed = fails(cell, report.gate),
            .scene = for_markdown(scene.name),
            .technique = cell.technique,
            .verdict = could_not_run(cell) ? "could not run" : std::string(name_of(cell.verdict)),
            .pixels = "",
            .causes = for_markdown(cell.error),
            .first = ""};
    if (!cell.error.empty()) return row;
    row.pixels = grouped(cell.comparison.differing);
    row.causes = cause_counts(cell.comparison.causes);
    for (const std::string& clause : unexplained_evidence(cell.comparison))
        row.causes += (row.causes.empty() ? "" : "; ") + for_markdown(clause);
    if (cell.since) row.causes += "; since the baseline: " + words_of(*cell.since);
    row.first = first_words(cell);
    return row;
}

Row scene_row(const SceneResult& scene) {
    return {.failed = true,
            .scene = for_markdown(scene.name),
            .technique = "",
            .verdict = scene.error.empty() ? "provokes no more" : "could not run",
            .pixels = "",
            .causes =
                for_markdown(scene.error.empty() ? no_longer_provoked_words(scene) : scene.error),
            .first = ""};
}

std::vector<Row> rows_of(const Report& report) {
    std::vector<Row> rows;
    for (const SceneResult& scene : report.scenes) {
        if (!scene.error.empty() || !scene.no_longer_provoked.empty())
            rows.push_back(scene_row(scene));
        for (const Cell& cell : scene.cells) rows.push_back(row_of(report, scene, cell));
    }
    std::stable_partition(rows.begin(), rows.end(), [](const Row& row) { return row.failed; });
    return rows;
}

/// GitHub drops a summary of more than 1 MiB as a whole; some of that is left to other steps.
constexpr std::size_t largest_table = 900 * 1024;

} // namespace

std::string to_workflow_commands(const Report& report) {
    std::string lines;
    for (const SceneResult& scene : report.scenes) {
        const std::string reproduce = reproducing_command(report, scene);
        if (!scene.error.empty())
            lines += error_line(scene, "shadowproof: " + scene.name, scene.error, reproduce);
        if (!scene.no_longer_provoked.empty())
            lines += error_line(scene, "shadowproof: " + scene.name,
                                no_longer_provoked_words(scene), reproduce);
        for (const Cell& cell : scene.cells)
            if (fails(cell, report.gate))
                lines += error_line(
                    scene,
                    fmt::format("shadowproof: {} on {}: {}", cell.technique, scene.name,
                                could_not_run(cell) ? "could not run" : name_of(cell.verdict)),
                    fmt::format("{}: {}", scene.file, why_it_fails(cell, report.gate)),
                    reproducing_command(report, scene, cell));
    }
    return lines;
}

std::string to_step_summary(const Report& report) {
    const std::vector<Row> rows = rows_of(report);
    const auto failed = static_cast<std::uint64_t>(
        std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.failed; }));
    std::string text = fmt::format("### shadowproof: {}\n\n",
                                   report.passed ? "passed" : counted(failed, "failure"));
    text += fmt::format("shadowproof {}, {}, OpenGL {}, gate {}", for_markdown(report.version),
                        for_markdown(report.gl.renderer), for_markdown(report.gl.version),
                        name_of(report.gate.on));
    for (const Allowance& allowance : report.gate.allow)
        text += fmt::format(", {} allowed", words_of(allowance));
    text += "\n\n| | scene | technique | verdict | differing | causes | first pixel |\n"
            "|---|---|---|---|---:|---|---|\n";
    std::size_t left = rows.size();
    for (const Row& row : rows) {
        if (text.size() > largest_table) break;
        text +=
            fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", row.failed ? "❌" : "✅", row.scene,
                        row.technique, row.verdict, row.pixels, row.causes, row.first);
        --left;
    }
    if (left > 0) text += fmt::format("\nand {} more in results.json\n", left);
    if (!report.baseline) return text + "\n";
    text += fmt::format("\nBaseline: {}\n", for_markdown(report.baseline->file));
    for (const std::string& note : report.baseline->notes)
        text += fmt::format("- {}\n", for_markdown(note));
    return text + "\n";
}

} // namespace shadowproof
