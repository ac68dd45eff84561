// The plain result of a run, and the writers that put it into words, JSON, JUnit and a folder of
// pictures. Writers only read.
#pragma once

#include "compare/classify.h"
#include "compare/gate.h"
#include "compare/ledger_table.h"
#include "compare/output/replaced_folder.h"
#include "compare/since.h"
#include "compare/verdict.h"
#include "reference/shading.h"
#include "reference/trace.h"
#include "scenes/frame.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// One technique on one scene.
struct Cell {
    std::string technique;
    std::string summary; ///< one clause: how the technique counts
    std::string error;   ///< not empty: the cell has no result; the rest but the verdict, if it is
                         ///< timed_out, is then meaningless
    Verdict verdict = Verdict::agrees;
    double milliseconds = 0;
    std::uint64_t volume_fragments = 0;
    std::vector<std::string> left_out;            ///< what the technique did without
    std::optional<Savings> saved;                 ///< by that
    std::vector<Cause> excused;                   ///< causes found that technique and scene excuse
    std::optional<Since> since;                   ///< against the same cell of a baseline
    std::optional<FirstDifference> first_failing; ///< the first pixel that fails the gate
    Comparison comparison;
    std::string cause_map; ///< of the comparison, packed as results.json holds it
    Frame frame;
    LedgerTable ledgers;
};

struct SceneResult {
    std::string name;
    std::string file;
    std::string argument; ///< what names the scene on the command line; empty: name
    int width = 0;
    int height = 0;
    std::size_t triangles = 0;
    std::string digest;       ///< of the scene's content, as digest_of gives it
    Light light;              ///< the one that is judged
    bool one_of_many = false; ///< the file's other lights are judged too, each by itself
    Camera camera;
    double far = 0; ///< the finite far plane of the techniques that have one
    std::vector<Mesh> meshes;
    std::vector<std::string> provokes;
    std::vector<std::string> left_out;
    std::vector<std::string> notes;
    std::vector<std::string> no_longer_provoked;
    std::string error; ///< not empty: the scene could not be traced; no cells then
    GroundTruth truth;
    bool bump_lit = false;   ///< its colours are judged, where techniques have some
    Image<glm::dvec3> color; ///< the true ones
    std::vector<Cell> cells;
};

/// The earlier run that this one was compared with.
struct Baseline {
    std::string file;
    bool passed = false;
    std::vector<std::string> notes; ///< what could not be compared, or differs beside pixels
};

struct Report {
    std::string version;
    DriverInfo gl;
    std::string embree;
    std::vector<std::string> arguments; ///< the settings that reproduce a cell: without the
                                        ///< program, the subcommand, scene, technique and outputs
    Gate gate;
    std::optional<Baseline> baseline;
    std::vector<SceneResult> scenes;
    bool passed = false;
    double milliseconds = 0;        ///< from the start of the process until the results are written
    double report_milliseconds = 0; ///< of them, ledgers, pictures and data of the report
};

/// One line a cell, as the console prints it, without colour: "zpass  near_plane  agrees  ...",
/// its first three columns padded to the widths given.
struct ColumnWidths {
    int technique = 0;
    int scene = 0;
    int verdict = 0;
};
std::string cell_line(const SceneResult& scene, const Cell& cell, const ColumnWidths& widths = {});

/// A cell without a result that nobody asked to give up: the run is not complete.
inline bool could_not_run(const Cell& cell) {
    return !cell.error.empty() && cell.verdict != Verdict::timed_out;
}

/// The verdict's name, or "error".
std::string_view outcome_name(const Cell& cell);

/// "edge 31, near_plane 1,173", in the order of all_causes; empty where nothing differs.
std::string cause_counts(const CausePixels& causes);

/// What a person needs to hear of a cell that fails or could not run: "edge 31, near_plane 1,173;
/// first (212,340) near_plane; ...", without how to reproduce it.
std::string why_it_fails(const Cell& cell, const Gate& gate);

/// "1,204"
std::string grouped(std::uint64_t number);

/// "1 cell", "1,204 cells"
std::string counted(std::uint64_t number, std::string_view thing);

/// The command that runs this cell alone, quoted for a POSIX shell.
std::string reproducing_command(const Report& report, const SceneResult& scene, const Cell& cell);
/// The same for the whole scene, with every technique.
std::string reproducing_command(const Report& report, const SceneResult& scene);

/// "no technique shows near_plane any more, which the scene declares"
std::string no_longer_provoked_words(const SceneResult& scene);

/// The scene's folder in the report: its name, unique in the run, in characters that every file
/// system and URL takes.
std::string folder_of(const SceneResult& scene);

/// "colour off by 1.04/255 at most (rmse 0.31, 99.9 % within 0.92)"
std::string words_of(const ColorCheck& colors);

/// "saved 3.1 ms and 271,004 of 800,123 volume fragments against zfail_reversed"
std::string words_of(const Savings& saved, std::uint64_t volume_fragments);

/// Names of files that every report has, besides manifest.json.
inline constexpr const char* page_name = "index.html";
inline constexpr const char* results_name = "results.json";
inline constexpr const char* results_script_name = "results.js";

/// Path, relative to the report's folder, of a cell's picture: kind is claim, difference, cause,
/// volumes.
std::string picture_path(const SceneResult& scene, const Cell& cell, const std::string& kind);

/// The same for the picture that all cells of a scene share.
std::string truth_path(const SceneResult& scene);
std::string color_path(const SceneResult& scene);

/// results.json of schema shadowproof/results/1.
std::string to_json(const Report& report);
/// JUnit XML: a suite a scene, a case a cell; valid by Ant's schema and by Jenkins'. `timestamp`:
/// when the run began, "2024-01-31T23:59:59".
std::string to_junit(const Report& report, const std::string& timestamp);
/// For GitHub Actions: a line `::error title=...::...` for each cell and scene that fails.
std::string to_workflow_commands(const Report& report);
/// For GitHub's step summary: the cells as a table in Markdown, failures first.
std::string to_step_summary(const Report& report);

/// The report's folder, with index.html, results.json and pictures, while it is being written
/// beside its place: compare/output/replaced_folder.h says what becomes of the folder that is
/// there.
class ReportFolder {
public:
    /// Throws Error where `folder` must not be replaced, or cannot be written.
    explicit ReportFolder(const std::filesystem::path& folder);

    /// Writes the truth and what else the cells of a scene share.
    void add_scene(const SceneResult& scene) const;
    /// Writes pictures and data of a cell, which may then be dropped, and packs its cause map.
    /// threads 0: one per core.
    void add_cell(const SceneResult& scene, Cell& cell, int threads = 0) const;
    /// Writes a file that is taken over from another report.
    void add_file(const std::string& name, std::string_view bytes) const;
    /// Writes a file that the user asked for by its name in this folder.
    void add_requested(const std::string& name, std::string_view bytes);
    /// Writes index.html, results.json and results.js, and replaces an older report.
    void finish(const Report& report);
    void finish(const std::string& results_json);

    /// What a person should hear of: files in the folder that were kept.
    const std::vector<std::string>& notes() const { return files_.notes(); }

private:
    ReplacedFolder files_;
};

} // namespace shadowproof
