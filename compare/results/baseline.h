// Compares a run with an earlier one: what is new, gone or changed since, by pixels.
#pragma once

#include "compare/cell.h"
#include "compare/results/results_file.h"

#include <string>
#include <vector>

namespace shadowproof {

/// The name by which a cause in a cell is accepted: the cause's own; for a picture's unexplained
/// pixels, that of its best hypothesis. Empty where there is none.
std::string accepted_name(const ResultsJson& cell, Cause cause);

/// Sets Cell::since, and Cell::accepted, where the baseline has the same cell of the same content
/// (equal digests). Throws Error naming the file where a cause map in it is damaged.
void compare_with(const ResultsFile& baseline, const SceneResult& scene, Cell& cell);

/// What notes_on needs of results: version, driver, and of scenes and cells the names, digests, and
/// whether they could be tried.
ResultsJson outline_of(const ResultsJson& results);
ResultsJson outline_of(const Report& report);

/// What could not be compared, and what differs besides pixels, one sentence each: another driver
/// or version, scenes of another content, cells that are new or were not tried. `was`, `now`:
/// outlines. `is_whole`: what is lacking now was not tried, and is not another shard's.
std::vector<std::string> notes_on(const ResultsJson& was, const ResultsJson& now, bool is_whole);

} // namespace shadowproof
