// What the judge catches: each fault of the catalogue on the bundled scenes until one catches it;
// of faults of any size, the smallest that is caught.
//   shadowproof_sensitivity [--scenes A,B] [--faults REGEX] [--page FILE] [--hold FILE [--part N]]
//   [-v]
// Prints a line for each fault: caught (where, by which verdict), escaped (where it changed most),
// or without effect. Exit code 1: with --hold, the page says more than is so, or not all.
#include "tests/sensitivity/page.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>
#include <regex>
#include <span>
#include <string>
#include <vector>

namespace shadowproof {
namespace {

using faults::Fault;

struct Explored {
    std::vector<Outcome> outcomes; ///< one per fault
    std::vector<Limit> limits;
};

/// Tries faults until they are caught, and those of any size until they are not. `chosen`: one of
/// each fault, 1 where it is to be tried.
Explored explore(const std::vector<std::string>& scenes, const std::vector<std::uint8_t>& chosen,
                 bool verbose) {
    const std::span<const Fault> catalogue = faults::all_faults();
    Explored explored{std::vector<Outcome>(catalogue.size()), limits_of(chosen)};
    std::vector<std::uint8_t> open = chosen;
    for (std::size_t i = 0; i < open.size(); ++i)
        if (is_scaled(catalogue[i])) open[i] = 0;
    Gpu gpu(GlPlatform::osmesa);
    for (const std::string& name : scenes) {
        Trial trial(load_to_try(name), gpu);
        for (std::size_t i = 0; i < catalogue.size(); ++i)
            for (const Technique& technique : all_techniques()) {
                if (open[i] == 0) break;
                if (!concerns(catalogue[i], technique, trial.scene())) continue;
                trial.run(static_cast<int>(i), technique, explored.outcomes[i]);
                if (explored.outcomes[i].caught) open[i] = 0;
            }
        lower(explored.limits, trial);
        if (verbose) fmt::print(stderr, "{}: {} faults left\n", name, std::ranges::count(open, 1));
    }
    return explored;
}

void print_outcomes(const std::vector<Outcome>& outcomes, const std::vector<std::uint8_t>& chosen) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (chosen[i] == 0 || is_scaled(faults::all_faults()[i])) continue;
        const Outcome& outcome = outcomes[i];
        const std::optional<TriedCell>& finding = outcome.caught ? outcome.caught : outcome.escaped;
        const char* const word =
            outcome.caught ? "caught" : (outcome.escaped ? "ESCAPED" : "no effect");
        fmt::print("{:9} {:34} {}\n", word, faults::all_faults()[i].name,
                   finding ? finding->place + " " + finding->verdict + " (" + finding->effect + ")"
                           : "");
    }
}

/// Another one each day.
int part_of_today() {
    const auto days = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    return static_cast<int>(days.time_since_epoch().count() % idle_parts);
}

} // namespace
} // namespace shadowproof

int main(int argc, char** argv) {
    using namespace shadowproof;
    CLI::App app("What the judge catches", "shadowproof_sensitivity");
    std::vector<std::string> scenes;
    std::string pattern = ".";
    std::string page;
    std::string held;
    int part = part_of_today();
    bool verbose = false;
    app.add_option("--scenes", scenes, "bundled scenes, by commas; all")->delimiter(',');
    app.add_option("--faults", pattern, "a regular expression of names");
    app.add_option("--page", page, "the page to write");
    app.add_option("--hold", held, "the page whose faults are tried where it says");
    app.add_option("--part", part,
                   "with --hold: which tenth of the faults without effect to try; today's")
        ->check(CLI::Range(0, idle_parts - 1));
    app.add_flag("-v", verbose, "say how far it is");
    CLI11_PARSE(app, argc, argv);
    if (!held.empty()) return holds(held, part) ? 0 : 1;
    std::vector<std::uint8_t> chosen;
    for (const faults::Fault& fault : faults::all_faults())
        chosen.push_back(std::regex_search(std::string(fault.name), std::regex(pattern)) ? 1 : 0);
    const Explored explored = explore(scene_names(scenes), chosen, verbose);
    print_outcomes(explored.outcomes, chosen);
    fmt::print("{}", table_of(explored.limits));
    if (!page.empty()) std::ofstream(page) << page_of(explored.outcomes, explored.limits);
    return 0;
}
