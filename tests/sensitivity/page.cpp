#include "tests/sensitivity/page.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <regex>
#include <span>

namespace shadowproof {

namespace {

using faults::Fault;

/// The places of a page's first table, by fault.
std::map<std::string, std::string> places_of(const std::string& file) {
    std::ifstream stream(file);
    std::map<std::string, std::string> places;
    const std::regex row(
        R"(\| `(\w[^`]*)` \| \w+ \| `([^`]+)` \| (defect|unexplained|refused) .*)");
    std::smatch match;
    for (std::string line; std::getline(stream, line);)
        if (std::regex_match(line, match, row)) places[match[1]] = match[2];
    return places;
}

} // namespace

std::string page_of(const std::vector<Outcome>& outcomes, const std::vector<Limit>& limits) {
    const std::span<const Fault> catalogue = faults::all_faults();
    std::string caught;
    std::string escaped;
    std::string without_effect;
    std::size_t count = 0;
    for (std::size_t i = 0; i < catalogue.size(); ++i) {
        const Fault& fault = catalogue[i];
        const Outcome& outcome = outcomes[i];
        if (is_scaled(fault)) continue;
        if (outcome.caught) {
            ++count;
            caught +=
                fmt::format("| `{}` | {} | `{}` | {} | {} |\n", fault.name, fault.kind,
                            outcome.caught->place, outcome.caught->verdict, outcome.caught->effect);
        } else if (outcome.escaped) {
            escaped += fmt::format("| `{}` | {} | `{}` | {} | {} | {} |\n", fault.name, fault.kind,
                                   outcome.escaped->place, outcome.escaped->verdict,
                                   outcome.escaped->effect, fault.why);
        } else {
            without_effect +=
                fmt::format("| `{}` | {} | {} |\n", fault.name, fault.kind, fault.why);
        }
    }
    return fmt::format(
        "# What the judge catches\n\n"
        "`unexplained 0` means something only if faults are not explained away. This page is "
        "written\n"
        "by `shadowproof_sensitivity --page docs/sensitivity.md`, which builds {} faults into the\n"
        "techniques, one at a time, and lets the judge look at each technique on each bundled "
        "scene\n"
        "at {}x{} until a cell fails. The faults stand in `tests/sensitivity/catalogue/`, no "
        "release\n"
        "holds them, and the test `sensitivity` tries each where this page says that it is "
        "caught.\n\n"
        "Faults of the kind *shared* are in code that techniques and judge have in common, and "
        "are\n"
        "switched on for both; all others are on while the technique draws.\n\n"
        "## How small a fault is caught\n\n"
        "Faults of any size are halved on each scene, with each technique, as long as one cell "
        "fails:\n"
        "the smallest that was caught, and by how much the rasterizer itself may be off.\n\n"
        "| fault | measured in | caught from | on | what it changes there | the rasterizer's own "
        "|\n"
        "|---|---|---|---|---|---|\n{}\n"
        "## Caught: {}\n\n"
        "| fault | of | on | verdict | what it changes there |\n|---|---|---|---|---|\n{}\n"
        "## Not caught\n\nWhere each changes most.\n\n"
        "| fault | of | on | verdict | what it changes there | why "
        "|\n|---|---|---|---|---|---|\n{}\n"
        "## Without effect on any bundled scene\n\n"
        "Byte for byte: claims, counters, surfaces, depths, colours and figures.\n\n"
        "| fault | of | why |\n|---|---|---|\n{}",
        catalogue.size(), tried_width, tried_height, table_of(limits), count, caught, escaped,
        without_effect);
}

bool holds(const std::string& file) {
    const std::span<const Fault> catalogue = faults::all_faults();
    const std::map<std::string, std::string> places = places_of(file);
    const std::vector<Limit> limits = limits_of_page(file);
    /// A fault, of a size or of none, and the technique that it is tried with.
    struct Told {
        std::size_t fault;
        int power;
        std::string technique;
    };
    std::map<std::string, std::vector<Told>> by_scene;
    const auto add = [&](std::size_t fault, int power, const std::string& place) {
        const std::size_t slash = place.find('/');
        by_scene[place.substr(0, slash)].push_back({fault, power, place.substr(slash + 1)});
    };
    bool all = !places.empty();
    for (const Limit& limit : limits) {
        const Fault& fault = catalogue[static_cast<std::size_t>(limit.number)];
        add(static_cast<std::size_t>(limit.number), limit.smallest, limit.finding.place);
        if (limit.smallest <= fault.aim) continue;
        fmt::print("{}: caught from 2^{} on, and aimed at is 2^{}\n", fault.name, limit.smallest,
                   fault.aim);
        all = false;
    }
    std::size_t scaled = 0;
    for (std::size_t i = 0; i < catalogue.size(); ++i) {
        scaled += is_scaled(catalogue[i]) ? 1U : 0U;
        if (const auto place = places.find(std::string(catalogue[i].name)); place != places.end())
            add(i, 0, place->second);
    }
    std::size_t caught = 0;
    Gpu gpu(GlPlatform::osmesa);
    for (const auto& [scene, those] : by_scene) {
        Trial trial(load_to_try(scene), gpu);
        for (const Told& told : those) {
            const Technique* technique = find_technique(told.technique);
            Outcome outcome;
            if (technique != nullptr)
                trial.run(static_cast<int>(told.fault), *technique, outcome, std::exp2(told.power));
            if (outcome.caught)
                ++caught;
            else
                fmt::print("{} is not caught on {}/{}\n", catalogue[told.fault].name, scene,
                           told.technique);
        }
    }
    fmt::print("{} of {} faults are caught, {} of {} limits stand\n", caught,
               places.size() + limits.size(), limits.size(), scaled);
    return all && caught == places.size() + limits.size() && limits.size() == scaled;
}

} // namespace shadowproof
