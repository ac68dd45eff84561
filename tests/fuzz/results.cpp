// Texts of results.json, two with a NUL between them: read, merged, compared with; or refused in a
// sentence.
#include "compare/results/baseline.h"
#include "compare/results/merge.h"
#include "scenes/error.h"
#include "tests/fuzz/findings.h"
#include "tests/fuzz/promises.h"
#include "tests/fuzz/target.h"

#include <optional>

namespace {

using namespace shadowproof;

std::optional<ResultsFile> parsed(const std::string& text, const std::string& file,
                                  fuzz::Input input) {
    try {
        return ResultsFile{file, parse_results(text, file)};
    } catch (const Error& error) {
        fuzz::check_message(error.what(), file, "results", input);
        return std::nullopt;
    }
}

/// What is written of results is read again as the same.
void check_text(const ResultsFile& file) {
    const std::string text = results_text(file.json);
    fuzz::require(results_text(parse_results(text, "again")) == text,
                  "results are read as they were written");
}

void check_merge(const std::vector<ResultsFile>& runs, fuzz::Input input) {
    const Matrix matrix{{{"zpass", {Cause::near_plane}, true},
                         {"zfail_reversed", {}, true},
                         {"bump_tangent_space", {}, false}},
                        {"near_plane", "sun"}};
    try {
        std::vector<IndexedResults> indexed;
        for (const ResultsFile& run : runs) indexed.push_back(index_results(run));
        const Merged merged = merge(indexed, matrix);
        ResultsJson whole = merged.head;
        for (std::size_t i = 0; i < merged.scenes.size(); ++i)
            whole["scenes"].push_back(whole_scene(merged, i, indexed).json);
        parse_results(results_text(whole), "merged");
    } catch (const Error& error) {
        // The result of a merge that did not throw must be results again.
        if (!std::string(error.what()).starts_with("merged"))
            fuzz::check_message(error.what(), "", "results", input);
        else
            fuzz::broken(std::string("what is merged are results: ") + error.what());
    }
}

/// A run of the same scenes in which nothing differs.
Report same_scenes(const ResultsJson& results) {
    constexpr std::uint64_t most_pixels = 1U << 16U;
    Report report;
    for (const ResultsJson& was : results["scenes"]) {
        if (was.contains("error")) continue;
        const auto width = was["width"].get<std::uint64_t>();
        const auto height = was["height"].get<std::uint64_t>();
        if (width * height > most_pixels) continue;
        SceneResult& scene = report.scenes.emplace_back();
        scene.name = was["name"].get<std::string>();
        scene.file = was["file"].get<std::string>();
        scene.digest = was["digest"].get<std::string>();
        scene.width = static_cast<int>(width);
        scene.height = static_cast<int>(height);
        for (const ResultsJson& old : was["techniques"]) {
            Cell& cell = scene.cells.emplace_back();
            cell.technique = old["name"].get<std::string>();
            cell.comparison.cause = Image<std::uint8_t>(scene.width, scene.height);
            cell.comparison.cause.pixels.assign(width * height, no_difference);
        }
    }
    return report;
}

void check_baseline(const ResultsFile& baseline, fuzz::Input input) {
    Report report = same_scenes(baseline.json);
    try {
        for (SceneResult& scene : report.scenes)
            for (Cell& cell : scene.cells) compare_with(baseline, scene, cell);
        notes_on(outline_of(baseline.json), outline_of(report), true);
    } catch (const Error& error) {
        fuzz::check_message(error.what(), baseline.path.string(), "results", input);
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const fuzz::Input input(bytes, size);
    const fuzz::TimePromise promise("results", input, 1);
    const std::string both(reinterpret_cast<const char*>(bytes), size);
    const std::size_t end = both.find('\0');
    std::vector<ResultsFile> runs;
    if (auto first = parsed(both.substr(0, end), "first.json", input)) runs.push_back(*first);
    if (end != std::string::npos)
        if (auto second = parsed(both.substr(end + 1), "second.json", input))
            runs.push_back(*second);
    for (const ResultsFile& run : runs) {
        check_text(run);
        check_baseline(run, input);
    }
    if (!runs.empty()) check_merge(runs, input);
    return 0;
}
