// The flags of the commands that judge a run: the gate, the baseline and the outputs.
#pragma once

#include "compare/gate.h"

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace shadowproof {

struct GateOptions {
    Gate gate;
    std::string baseline; ///< an earlier results.json, or its folder; empty: none
};

struct OutputOptions {
    std::string out = "report";
    std::string json;
    std::string junit;
    bool quiet = false;
    bool verbose = false;
};

/// Values are checked as they are parsed: a bad one is wrong usage.
void add_gate_flags(CLI::App& command, GateOptions& options);
void add_output_flags(CLI::App& command, OutputOptions& options);

/// The gate's flags that differ from their defaults, as words of a command line.
std::vector<std::string> settings(const GateOptions& options);

} // namespace shadowproof
