// The result of a run as plain data: for each scene one cell per technique. The gate judges it, and
// the writers of compare/report write it.
#pragma once

#include "compare/classify.h"
#include "compare/gate.h"
#include "compare/since.h"
#include "compare/verdict.h"
#include "reference/shade/shading.h"
#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// A cause that a reviewer has accepted in a cell of the baseline, and why.
struct Acceptance {
    Cause cause = Cause::edge;
    std::string reason;
};

/// One technique on one scene.
struct Cell {
    std::string technique;
    std::string family;  ///< family of claims, which decides how it is judged
    std::string summary; ///< one clause: how the technique works
    /// Where no technique made the cell: the command that makes it again, as words after the
    /// program's name.
    std::vector<std::string> command;
    std::string error; ///< if not empty, the cell has no result, and the other members are
                       ///< meaningless, except the verdict if it is timed_out
    Verdict verdict = Verdict::agrees;
    double milliseconds = 0;
    double spent_milliseconds = 0;     ///< in all: drawing, judging, writing; 0: not known
    std::vector<std::string> left_out; ///< what the technique omitted as not needed
    std::vector<Cause> excused;        ///< causes found that technique and scene excuse
    std::optional<Since> since;        ///< change since the same cell of a baseline
    std::vector<Acceptance> accepted;  ///< in that cell of the baseline
    std::optional<FirstDifference> first_failing; ///< the first pixel that fails the gate
    Comparison comparison;
    std::string cause_map; ///< the comparison's causes, packed as in results.json
    Frame frame;
    std::shared_ptr<const EvidenceReport> evidence; ///< for the report; null: nothing is shown
    /// By kind, where those of its pictures stand that are the same as an earlier cell's.
    std::map<std::string, std::string> same_pictures{};
};

struct SceneResult {
    std::string name;
    std::string file;
    std::string argument; ///< the scene's name on the command line; if empty, `name`
    int width = 0;
    int height = 0;
    std::size_t triangles = 0;
    std::string digest;       ///< of the scene's content, as digest_of gives it
    Light light;              ///< the light that is judged
    bool one_of_many = false; ///< the file has other lights, each judged by itself
    Camera camera;
    double far = 0; ///< the finite far plane of the techniques that have one
    std::vector<Mesh> meshes;
    std::vector<std::string> provokes;
    std::vector<std::string> left_out;
    std::vector<std::string> notes;
    std::vector<std::string> no_longer_provoked;
    std::string error; ///< if not empty, the scene could not be traced and has no cells
    GroundTruth truth;
    bool bump_lit = false;         ///< colours are judged, of techniques that have them
    Image<glm::dvec3> color;       ///< the true colours
    Image<glm::dvec3> mean_color;  ///< their means over the pixels, of techniques that filter
    double spent_milliseconds = 0; ///< before its cells: reading, tracing, writing; 0: not known
    std::vector<Cell> cells;
};

/// The earlier run that this one was compared with.
struct Baseline {
    std::string file;
    bool passed = false;
    std::vector<std::string> notes; ///< what could not be compared, or differs besides pixels
};

/// The part of a run that a report is of.
struct ReportShard {
    std::size_t number = 1; ///< from 1 on
    std::size_t of = 1;
    std::string run;      ///< the same for the shards of one run, and no others
    std::string baseline; ///< its outline (compare/results/baseline.h), as JSON; empty: none
};

struct Report {
    std::string version;
    DriverInfo gl;
    std::string embree;
    std::vector<std::string> arguments; ///< the settings that reproduce a cell: without the
                                        ///< program, the subcommand, scene, technique and outputs
    Gate gate;
    std::optional<Baseline> baseline;
    std::optional<ReportShard> shard;
    std::vector<SceneResult> scenes;
    bool passed = false;
    double milliseconds = 0;        ///< from the start of the process until the results are written
    double report_milliseconds = 0; ///< part of these, for the report's ledgers, pictures and data
};

/// Whether the cell has no result for a reason other than a time limit: the run is then incomplete.
inline bool could_not_run(const Cell& cell) {
    return !cell.error.empty() && cell.verdict != Verdict::timed_out;
}

} // namespace shadowproof
