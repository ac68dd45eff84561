#include "compare/command/gate_options.h"

#include "compare/command/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>

namespace shadowproof {

namespace {

void add_allowance(Gate& gate, const std::string& text) {
    try {
        const Allowance allowance = parse_allowance(text);
        if (std::any_of(gate.allow.begin(), gate.allow.end(),
                        [&](const Allowance& other) { return other.cause == allowance.cause; }))
            throw std::invalid_argument(
                fmt::format("{} is given twice; give it once", name_of(allowance.cause)));
        gate.allow.push_back(allowance);
    } catch (const std::invalid_argument& error) {
        throw CLI::ValidationError("--allow", error.what());
    }
}

GateOn parse_gate(const std::string& text) {
    if (text == "defects") return GateOn::defects;
    if (text == "differences") return GateOn::differences;
    throw CLI::ValidationError("--gate",
                               "'" + text + "' is not known; give defects or differences");
}

} // namespace

void add_gate_flags(CLI::App& command, GateOptions& options) {
    command
        .add_option_function<std::string>(
            "--gate", [&](const std::string& text) { options.gate.on = parse_gate(text); },
            "Fail on defects, or on all differences beyond edges (defects)")
        ->type_name("defects|differences");
    command
        .add_option_function<std::vector<std::string>>(
            "--allow",
            [&](const std::vector<std::string>& texts) {
                options.gate.allow.clear();
                for (const std::string& text : texts) add_allowance(options.gate, text);
            },
            "Causes that do not fail a cell, separated by commas; CAUSE=N: up to N pixels of it")
        ->delimiter(',')
        ->allow_extra_args(false) // a scene may follow
        ->type_name("CAUSE[=N]");
    command
        .add_option("--baseline", options.baseline,
                    "An earlier results.json or report: say what is new, gone or changed since; "
                    "with --gate differences fail on what is new or changed alone")
        ->type_name("FILE")
        ->check(not_empty());
}

void add_output_flags(CLI::App& command, OutputOptions& options) {
    command.add_option("--out", options.out, "Folder of the report (report)")
        ->type_name("DIR")
        ->check(not_empty());
    command.add_option("--json", options.json, "Also write the results here")
        ->type_name("FILE")
        ->check(not_empty());
    command.add_option("--junit", options.junit, "Also write JUnit XML here")
        ->type_name("FILE")
        ->check(not_empty());
    CLI::Option* quiet =
        command.add_flag("-q,--quiet", options.quiet, "Only what failed, and the end");
    command
        .add_flag("-v,--verbose", options.verbose,
                  "Also what a scene does not need and was left out, and all notes, not three")
        ->excludes(quiet);
}

std::vector<std::string> settings(const GateOptions& options) {
    std::vector<std::string> words;
    if (options.gate.on == GateOn::differences) words = {"--gate", "differences"};
    for (const Allowance& allowance : options.gate.allow) {
        words.emplace_back("--allow");
        words.push_back(words_of(allowance));
    }
    if (!options.baseline.empty()) {
        words.emplace_back("--baseline");
        words.push_back(options.baseline);
    }
    return words;
}

} // namespace shadowproof
