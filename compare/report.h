// The plain result of a run, and the writers that put it into words, JSON, JUnit and a folder of
// pictures. Writers only read.
#pragma once

#include "compare/classify.h"
#include "compare/verdict.h"
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
    std::string error; ///< not empty: the cell could not run; the rest is then meaningless
    Verdict verdict = Verdict::agrees;
    double milliseconds = 0;
    Comparison comparison;
    Frame frame;
};

struct SceneResult {
    std::string name;
    std::string file;
    int width = 0;
    int height = 0;
    std::size_t triangles = 0;
    std::string light;
    std::vector<std::string> provokes;
    std::vector<std::string> left_out;
    std::vector<std::string> notes;
    std::vector<std::string> no_longer_provoked;
    std::string error; ///< not empty: the scene could not be traced; no cells then
    GroundTruth truth;
    std::vector<Cell> cells;
};

struct Report {
    std::string version;
    DriverInfo gl;
    std::string embree;
    std::vector<std::string> arguments; ///< that reproduce the run, without the program's name
    std::vector<SceneResult> scenes;
    bool passed = false;
};

/// One line a cell, as the console prints it, without colour.
std::string cell_line(const Cell& cell);

/// Path, relative to the report's folder, of a cell's picture: kind is claim, difference, cause.
std::string picture_path(const SceneResult& scene, const Cell& cell, const std::string& kind);

/// results.json of schema shadowproof/results/1.
std::string to_json(const Report& report);
/// JUnit XML: a suite a scene, a case a cell.
std::string to_junit(const Report& report);
/// The folder with index.html, results.json and pictures; written beside and renamed into place.
void write_html(const Report& report, const std::filesystem::path& folder);

/// Writes text beside `file` and renames it into place. Throws Error naming the file.
void write_file(const std::filesystem::path& file, const std::string& text);

} // namespace shadowproof
