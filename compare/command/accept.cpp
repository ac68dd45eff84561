#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/outcome.h"
#include "compare/command/output_files.h"
#include "compare/command/process/console.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/standard_output.h"
#include "compare/output/write_file.h"
#include "compare/results/baseline.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

namespace shadowproof {

namespace {

struct AcceptOptions {
    std::string results;
    std::string output;
    std::string earlier; ///< an accepted baseline whose reasons still hold; empty: none
    std::map<std::string, std::string> reasons;
    bool quiet = false;
    MemoryBudget memory{};
};

/// What must be accepted by one name.
struct Found {
    std::uint64_t pixels = 0;
    std::uint64_t cells = 0;
    std::string first;  ///< "zpass on near_plane"
    std::string reason; ///< by which it was accepted in the baseline of these results
};

std::string place_of(const ResultsJson& scene, const ResultsJson& cell) {
    return fmt::format("{} on {}", shown(cell.at("name")), shown(scene.at("name")));
}

/// By cause, what was accepted already when the cell was judged.
ResultsJson reasons_in(const ResultsJson& cell) {
    ResultsJson reasons = ResultsJson::object();
    if (cell.contains("accepted"))
        for (const ResultsJson& one : cell.at("accepted"))
            reasons[one.at("cause").get<std::string>()] = one.at("reason");
    return reasons;
}

/// A cell that did not run cannot have been reviewed, and unexplained pixels may hide any fault.
void require_name(const AcceptOptions& options, const std::string& place, const std::string& name) {
    if (name.empty())
        throw Error(options.results, place + " has unexplained pixels",
                    "find their cause: nobody knows what they hide");
}

/// By the names that acceptances have, of the cells that fail.
std::map<std::string, Found> to_be_accepted(const AcceptOptions& options,
                                            const ResultsJson& results) {
    std::map<std::string, Found> all;
    for (const ResultsJson& scene : results.at("scenes")) {
        if (scene.contains("error"))
            throw Error(options.results, shown(scene.at("name")) + " could not be tried",
                        "mend that, and run it again");
        for (const ResultsJson& cell : scene.at("techniques")) {
            const std::string place = place_of(scene, cell);
            if (cell.contains("error"))
                throw Error(options.results, place + " could not run",
                            "mend that, and run it again");
            const ResultsJson accepted = reasons_in(cell);
            for (const auto& [cause, pixels] : cell.at("causes").items()) {
                if (cause == name_of(Cause::edge) || pixels == 0) continue;
                if (cell.at("fails") != true && !accepted.contains(cause)) continue;
                const std::string name = accepted_name(cell, *cause_named(cause));
                require_name(options, place, name);
                Found& found = all[name];
                if (found.cells == 0) found.first = place;
                ++found.cells;
                found.pixels += pixels.get<std::uint64_t>();
                if (accepted.contains(cause)) found.reason = accepted.at(cause);
            }
        }
    }
    return all;
}

std::string words_of(const std::string& name, const Found& found) {
    return fmt::format("{}: {} in {}, first {}", name, counted(found.pixels, "pixel"),
                       counted(found.cells, "cell"), found.first);
}

/// The reason for each name, given now or earlier. Says which are missing, and which are given but
/// not needed.
bool find_reasons(const AcceptOptions& options, const std::map<std::string, Found>& found,
                  const ResultsJson& earlier, ResultsJson& reasons) {
    bool complete = true;
    for (const auto& [name, what] : found) {
        const auto given = options.reasons.find(name);
        if (given != options.reasons.end()) {
            reasons[name] = given->second;
        } else if (earlier.contains(name)) {
            reasons[name] = earlier.at(name);
        } else if (!what.reason.empty()) {
            reasons[name] = what.reason;
        } else {
            complain(fmt::format("{}; give a reason: --reason '{}=why this is right to accept'",
                                 words_of(name, what), name));
            complete = false;
        }
    }
    for (const auto& [name, reason] : options.reasons)
        if (!found.contains(name)) {
            complain(fmt::format("--reason {}: no cell fails by that; leave it out", name));
            complete = false;
        }
    return complete;
}

int accept(const AcceptOptions& options, int watcher) {
    Console console(options.quiet, watcher);
    check_writable(options.output);
    MemoryAccount memory(options.memory);
    ResultsFile results = read_results(options.results, &memory);
    ResultsJson earlier = ResultsJson::object();
    if (!options.earlier.empty()) {
        const ResultsFile file = read_results(options.earlier, &memory);
        if (!file.json.contains("accepted"))
            throw Error(options.earlier, "holds no reasons: it was never accepted",
                        "name a file that shadowproof accept wrote");
        earlier = file.json.at("accepted").at("reasons");
    }
    const std::map<std::string, Found> found = to_be_accepted(options, results.json);
    ResultsJson reasons = ResultsJson::object();
    if (!find_reasons(options, found, earlier, reasons)) return exit_usage;
    results.json["accepted"] = {{"at", timestamp_now()}, {"reasons", reasons}};
    write_file(options.output, results_text(results.json));
    for (const auto& [name, what] : found)
        console.line(fmt::format("accepted: {}: {}", words_of(name, what),
                                 reasons[name].get<std::string>()));
    console.line(fmt::format("baseline in {}: give it with --baseline", options.output));
    return exit_passed;
}

void add_reason(AcceptOptions& options, const std::string& text) {
    const std::size_t sign = text.find('=');
    if (sign == 0 || sign == std::string::npos ||
        text.find_first_not_of(" \t", sign + 1) == std::string::npos)
        throw CLI::ValidationError(
            "--reason", "'" + text + "' gives no reason; give CAUSE=TEXT, as near_plane='#12'");
    if (!options.reasons.emplace(text.substr(0, sign), text.substr(sign + 1)).second)
        throw CLI::ValidationError("--reason",
                                   text.substr(0, sign) + " is given twice; give it once");
}

} // namespace

Work add_accept(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "accept", "A baseline of results that were reviewed, with a reason for each cause");
    const auto options = std::make_shared<AcceptOptions>();
    command
        ->add_option("RESULTS", options->results,
                     "The folder of a report, or a results.json, as verify and check write them")
        ->required()
        ->check(not_empty());
    command
        ->add_option("-o,--output", options->output,
                     "The baseline, for --baseline of verify and check")
        ->type_name("FILE")
        ->required()
        ->check(not_empty());
    command
        ->add_option_function<std::vector<std::string>>(
            "--reason",
            [options](const std::vector<std::string>& texts) {
                options->reasons.clear();
                for (const std::string& text : texts) add_reason(*options, text);
            },
            "Why a cause is accepted, or a picture's hypothesis; needed for each that fails")
        ->allow_extra_args(false)
        ->type_name("CAUSE=TEXT");
    command
        ->add_option("--reasons-of", options->earlier,
                     "An earlier baseline, whose reasons hold where none is given now")
        ->type_name("FILE")
        ->check(not_empty());
    add_memory_flag(*command, options->memory);
    command->add_flag("-q,--quiet", options->quiet, "No output but errors");
    return [options] { return guarded([&](int watcher) { return accept(*options, watcher); }); };
}

} // namespace shadowproof
