// The options of `bench`.
#pragma once

#include "compare/bench/bench_run.h"
#include "compare/bench/rounds.h"
#include "compare/command/options.h"
#include "compare/command/pieces/supervisor.h"

#include <string>
#include <vector>

namespace shadowproof {

struct BenchOptions {
    std::vector<std::string> scenes; ///< names or paths; empty: all bundled ones
    SceneOptions scene;
    TechniqueOptions technique;
    BenchSettings fixed;            ///< swept settings that a flag has set: they are swept no more
    RoundLimits limits;             ///< for each scene
    double scene_seconds = 0;       ///< after which no sample of a scene is begun; 0: no such limit
    double timeout = usual_timeout; ///< seconds for a judgement, a sample, or tracing; 0: no limit
    bool quick = false;
    bool scaling = false;
    bool resume = false;
    std::string from;    ///< redraw this run, and measure nothing
    std::string against; ///< an older run
    std::string out = "report";
    std::string json;
    std::string csv;
    bool pictures = true;
    bool quiet = false;
};

} // namespace shadowproof
