// The gate: decides what fails a run. It is the only place that does; allowances do not change
// verdicts.
#pragma once

#include "scenes/cause.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

struct Cell;
struct FirstDifference;
struct SceneResult;

enum class GateOn : std::uint8_t {
    defects,     ///< causes beyond those that technique and scene excuse
    differences, ///< any cause
};

/// Pixels of a cause that do not fail a cell: `near_plane`, or `near_plane=12` for up to twelve.
struct Allowance {
    Cause cause = Cause::edge;
    std::optional<std::uint64_t> pixels; ///< in each cell; none: any number
};

struct Gate {
    GateOn on = GateOn::defects;
    std::vector<Allowance> allow;
};

/// Pixels by cause, in the order of all_causes.
using CausePixels = std::array<std::uint64_t, all_causes.size()>;

/// The pixels of a cell that count against it, by cause. `edge` never counts. Under GateOn::defects
/// neither do causes that the cell excuses; under GateOn::differences, where the cell was compared
/// with a baseline, only pixels count that are new since or have changed cause. A cause that is
/// allowed, and has no more such pixels than allowed, counts none; one that has more counts all.
/// Of a cause that was accepted in the baseline, only new and changed pixels count, under either
/// gate. Otherwise `unexplained` always counts: neither a baseline nor an allowance excuses it.
CausePixels pixels_that_fail(const Cell& cell, const Gate& gate);

/// The pixels that would count without the gate's allowances, and do not with them.
CausePixels pixels_allowed(const Cell& cell, const Gate& gate);

/// A cell fails where it could not run, a counter, surface or figure is unexplained, or any pixel
/// counts.
bool fails(const Cell& cell, const Gate& gate);
/// A scene: an error, a cause no longer provoked, or a failing cell.
bool fails(const SceneResult& scene, const Gate& gate);

/// The first pixel, in rows from the top, of a cause that counts; needs Comparison::cause. Where
/// only changes count, the first change that does. None where no pixel counts.
std::optional<FirstDifference> first_that_fails(const Cell& cell, const Gate& gate);

/// "near_plane" or "near_plane=12", as on the command line. Throws std::invalid_argument with a
/// sentence that lists what is possible; for `unexplained`, why it is not.
Allowance parse_allowance(const std::string& text);
std::string words_of(const Allowance& allowance);

std::string_view name_of(GateOn on);

} // namespace shadowproof
