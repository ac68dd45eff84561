// The writers of a run's result: as text, JSON, JUnit and a folder with pictures. They judge
// nothing.
#pragma once

#include "compare/cell.h"
#include "compare/json/memo.h"
#include "compare/output/replaced_folder.h"
#include "compare/report/growing_results.h"
#include "compare/report/shared_files.h"
#include "compare/words.h"

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowproof {

/// One line per cell, as the console prints it, without colour: "zpass  near_plane  agrees  ...",
/// its first three columns padded to the widths given.
struct ColumnWidths {
    int technique = 0;
    int scene = 0;
    int verdict = 0;
};
std::string cell_line(const SceneResult& scene, const Cell& cell, const ColumnWidths& widths = {});

/// The verdict's name, or "error".
std::string_view outcome_name(const Cell& cell);

/// "edge 31, near_plane 1,173", in the order of all_causes; empty where nothing differs.
std::string cause_counts(const CausePixels& causes);

/// "1,173 wrong pixels excused: zpass is known for near_plane": those that do not fail a cell
/// because technique and scene excuse their causes. Empty where there are none.
std::string excused_words(const Cell& cell, const Gate& gate);

/// Why a cell fails or could not run: "edge 31, near_plane 1,173; first (212,340) near_plane; ...",
/// without how to reproduce it.
std::string why_it_fails(const Cell& cell, const Gate& gate);

/// The command that runs this cell alone, quoted for a POSIX shell.
std::string reproducing_command(const Report& report, const SceneResult& scene, const Cell& cell);
/// The same for the whole scene, with every technique.
std::string reproducing_command(const Report& report, const SceneResult& scene);

/// "no technique shows near_plane any more, which the scene declares"
std::string no_longer_provoked_words(const SceneResult& scene);

/// The scene's folder in the report: its name, unique in the run, in characters that every file
/// system and URL takes.
std::string folder_of(const SceneResult& scene);

/// "colour off by 1.04/255 at most (rmse 0.31, 99.9 % within 0.92; of the whole picture rmse 4.5)"
std::string words_of(const ColorCheck& colors);

/// Names of files that every report has, besides manifest.json.
inline constexpr const char* page_name = "index.html";
inline constexpr const char* results_name = "results.json";
inline constexpr const char* results_script_name = "results.js";

/// Path, relative to the report's folder, of a cell's picture, by its kind. That of an earlier cell
/// where that is the same.
std::string picture_path(const SceneResult& scene, const Cell& cell, const std::string& kind);

/// The kinds of the pictures that each cell that ran has as files. The page draws all others.
inline constexpr std::array<const char*, 3> picture_kinds{"claim", "difference", "cause"};

/// The same for the picture that all cells of a scene share.
std::string truth_path(const SceneResult& scene);

inline constexpr std::string_view results_schema = "shadowproof/results/1";
/// Format of the data beside the results: a viewer reads only its own format.
inline constexpr int results_format = 10;

/// results.json of that schema.
std::string to_json(const Report& report);
/// JUnit XML: one suite per scene, one case per cell; valid by Ant's schema and by Jenkins'.
/// `timestamp`: when the run began, "2024-01-31T23:59:59". `folder`: the report's, whose pictures
/// of cells that fail are attached; empty: none are.
std::string to_junit(const Report& report, const std::string& timestamp,
                     const std::filesystem::path& folder = {});
/// What CTest takes from a test's output and CDash shows beside it: the pictures of cells that
/// fail.
std::string to_ctest_measurements(const Report& report, const std::filesystem::path& folder);
/// For GitHub Actions: a line `::error title=...::...` for each cell and scene that fails.
std::string to_workflow_commands(const Report& report);
/// For GitHub's step summary: the cells as a table in Markdown, failures first.
std::string to_step_summary(const Report& report);

/// The report's folder, with index.html, results.json and pictures, while it is being written
/// beside its place. For what happens to an existing folder see compare/output/replaced_folder.h.
class ReportFolder {
public:
    /// As ReplacedFolder. Throws Error where `folder` must not be replaced, or cannot be written.
    explicit ReportFolder(const std::filesystem::path& folder, CutOff cut_off = CutOff::is_removed);

    /// Of a report whose writing was cut off: see ReplacedFolder.
    bool goes_on() const { return files_.goes_on(); }
    void begin_anew() { files_.begin_anew(); }
    std::filesystem::path progress_file() const { return files_.progress_file(); }
    static std::filesystem::path progress_file_of(const std::filesystem::path& folder) {
        return ReplacedFolder::progress_file_of(folder);
    }

    /// Writes the truth and what else the cells of a scene share. Its cells must be added before
    /// the next scene: what they have alike is then compressed, and written, once.
    void add_scene(const SceneResult& scene) const;
    /// Writes pictures and data of a cell, which may then be dropped, packs its cause map, and
    /// notes where its pictures stand. threads 0: one per core.
    void add_cell(const SceneResult& scene, Cell& cell, int threads = 0) const;
    /// A cell that an earlier process has added: later ones may share what it wrote.
    void recall_cell(const SceneResult& scene, const Cell& cell) const;
    /// Writes a file that is taken over from another report.
    void add_file(const std::string& name, std::string_view bytes) const;
    /// The same for a cell's picture, unless an earlier one of its scene is the same. Returns where
    /// it stands.
    std::string add_picture(const std::string& name, std::string_view bytes) const;
    /// The same for a cell's data, without the blocks that an earlier one of its scene has.
    void add_script(const std::string& name, const std::string& script) const;
    /// Writes a file that the user requested by its name in this folder.
    void add_requested(const std::string& name, std::string_view bytes);
    /// Writes index.html, results.json and results.js, and replaces an older report.
    void finish(const Report& report);
    /// The same where the results come scene by scene: they must have ended before finish().
    GrowingResults grow_results(nlohmann::ordered_json head,
                                const std::optional<std::string>& requested);
    void finish();

    /// Messages for the user: files in the folder that were kept.
    const std::vector<std::string>& notes() const { return files_.notes(); }

private:
    ReplacedFolder files_;
    std::unique_ptr<Memo> memo_;          ///< of the scene added last
    std::unique_ptr<SharedFiles> shared_; ///< of its cells
};

} // namespace shadowproof
