// The data files of a report: what the viewer reads when a cell is opened. They are scripts, since
// a page opened from disk may load scripts and nothing else.
#pragma once

#include "compare/report/report.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace shadowproof {

/// FOLDER/scene.js: camera, light, meshes and the truth, for all cells of a scene; of bump-lit
/// scenes with the true colours.
std::string scene_script(const SceneResult& scene);

/// FOLDER/TECHNIQUE.cell.js: the claim of all pixels, with shares of light where it has some, and
/// what its family's evidence has to show (EvidenceReport); where the technique has colours, those
/// too, with their verdicts.
std::string cell_script(const SceneResult& scene, const Cell& cell, Memo& memo);

/// results.js: the results as a script, whose scenes are packed. Besides results.json the only file
/// with times.
std::string results_script(const std::string& results_json);
/// A scene of the results as it stands there: packed, without the cause maps, which the cells' data
/// hold.
std::string packed_scene(nlohmann::ordered_json scene);

/// The cause map as it stands in results.json: packed, one byte per pixel.
std::string packed_cause_map(const Comparison& comparison, Memo* memo = nullptr);

} // namespace shadowproof
