// The options of `stress`.
#pragma once

#include "compare/command/options.h"
#include "compare/command/pieces/supervisor.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shadowproof {

struct StressOptions {
    std::vector<std::string> scenes; ///< names or paths; empty: all bundled ones
    SceneOptions scene;
    TechniqueOptions technique;
    std::vector<std::string> parameters; ///< empty: all that suit
    std::uint64_t witness = 64;          ///< pixels of each point that the witness decides again
    double timeout = usual_timeout;      ///< seconds for a cell, or for tracing; 0: no limit
    std::string out = "report";
    std::string json;
    bool pictures = true;
    bool quiet = false;
};

} // namespace shadowproof
