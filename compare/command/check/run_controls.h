// Negative controls of a picture: whether this check of this scene would have caught such a fault.
#pragma once

#include "compare/gate.h"
#include "compare/picture/controls.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shadowproof {

struct ControlOutcome {
    std::string control; ///< Control::control
    std::string words;
    std::uint64_t changed = 0; ///< pixels of the truth
    std::uint64_t wrong = 0;   ///< pixels that the check counts against it; without edge
    bool caught = false;       ///< by the gate
    std::string why_not;       ///< where it is not caught
};

/// Puts each control through the reading of `own`, the judge and the gate.
std::vector<ControlOutcome> run_controls(const TracedScene& traced, const Frame& own,
                                         const Gate& gate);

/// For results.json.
nlohmann::ordered_json controls_json(const std::vector<ControlOutcome>& outcomes);

/// A line each; then how many were caught, and the smallest of those.
std::vector<std::string> controls_lines(const std::vector<ControlOutcome>& outcomes);

} // namespace shadowproof
