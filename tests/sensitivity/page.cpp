#include "tests/sensitivity/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <span>

namespace shadowproof {

namespace {

using faults::Fault;

constexpr const char* caught_heading = "## Caught: ";
constexpr const char* escaped_heading = "## Not caught";
constexpr const char* without_effect_heading = "## Without effect on any bundled scene";

/// What a page says of a fault.
struct Row {
    std::string fault;
    std::string place; ///< where it is caught, or changes most; empty where it changes nothing
    std::string why;   ///< where it is not caught
};

/// A page's three tables of faults.
struct Page {
    std::vector<Row> caught;
    std::vector<Row> escaped;
    std::vector<Row> without_effect;
    std::string text;
};

Page read_page(const std::string& file) {
    std::ifstream stream(file);
    Page page;
    std::vector<Row>* table = nullptr;
    const std::regex caught(R"(\| `([^`]+)` \| \w+ \| `([^`]+)` \| \w+ \| .* \|)");
    const std::regex escaped(R"(\| `([^`]+)` \| \w+ \| `([^`]+)` \| \w+ \| [^|]* \| (.*) \|)");
    const std::regex without_effect(R"(\| `([^`]+)` \| \w+ \| (.*) \|)");
    std::smatch match;
    for (std::string line; std::getline(stream, line);) {
        page.text += line + "\n";
        if (line.starts_with(caught_heading)) table = &page.caught;
        if (line.starts_with(escaped_heading)) table = &page.escaped;
        if (line.starts_with(without_effect_heading)) table = &page.without_effect;
        if (table == &page.caught && std::regex_match(line, match, caught))
            table->push_back({match[1], match[2], ""});
        if (table == &page.escaped && std::regex_match(line, match, escaped))
            table->push_back({match[1], match[2], match[3]});
        if (table == &page.without_effect && std::regex_match(line, match, without_effect))
            table->push_back({match[1], "", match[2]});
    }
    return page;
}

std::optional<std::size_t> number_of(const std::string& name) {
    const std::span<const Fault> catalogue = faults::all_faults();
    const auto found = std::ranges::find(catalogue, name, &Fault::name);
    if (found == catalogue.end()) return std::nullopt;
    return static_cast<std::size_t>(found - catalogue.begin());
}

/// How often each fault of the catalogue stands in one of the tables, and by which words.
bool is_complete(const Page& page) {
    const std::span<const Fault> catalogue = faults::all_faults();
    std::vector<int> rows(catalogue.size());
    bool all = true;
    const auto say = [&](const std::string& words) {
        fmt::print("{}\n", words);
        all = false;
    };
    const auto add = [&](const std::vector<Row>& table, bool needs_reason) {
        for (const Row& row : table) {
            const std::optional<std::size_t> number = number_of(row.fault);
            if (!number) {
                say(row.fault + " is on the page and not in the catalogue");
                continue;
            }
            ++rows[*number];
            if (!needs_reason) continue;
            if (row.why.empty()) say(row.fault + " is not caught, and no reason is given");
            if (row.why != catalogue[*number].why)
                say(row.fault + " has another reason in the catalogue");
        }
    };
    add(page.caught, false);
    add(page.escaped, true);
    add(page.without_effect, true);
    for (std::size_t i = 0; i < catalogue.size(); ++i) {
        const int expected = is_scaled(catalogue[i]) ? 0 : 1;
        if (rows[i] != expected)
            say(fmt::format("{} has {} rows on the page", catalogue[i].name, rows[i]));
    }
    for (const std::string& stated : {fmt::format("builds {} faults", catalogue.size()),
                                      fmt::format("{}{}\n", caught_heading, page.caught.size())})
        if (page.text.find(stated) == std::string::npos) say("the page does not say: " + stated);
    return all;
}

/// Tries faults that are without effect on all scenes. Whether they are.
bool are_without_effect(const std::vector<std::size_t>& numbers, Gpu& gpu) {
    std::vector<Outcome> outcomes(numbers.size());
    for (const std::string& scene : scene_names({})) {
        Trial trial(load_to_try(scene), gpu);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            for (const Technique& technique : all_techniques())
                if (concerns(faults::all_faults()[numbers[i]], technique, trial.scene()))
                    trial.run(static_cast<int>(numbers[i]), technique, outcomes[i]);
    }
    bool all = true;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const Outcome& outcome = outcomes[i];
        const std::optional<TriedCell>& finding = outcome.caught ? outcome.caught : outcome.escaped;
        if (!finding) continue;
        fmt::print("{} has an effect on {}: {}\n", faults::all_faults()[numbers[i]].name,
                   finding->place, finding->effect);
        all = false;
    }
    return all;
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
        "caught\nor escapes, and of those without effect a tenth each day on all scenes.\n\n"
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
        "{}{}\n\n"
        "| fault | of | on | verdict | what it changes there |\n|---|---|---|---|---|\n{}\n"
        "{}\n\nWhere each changes most.\n\n"
        "| fault | of | on | verdict | what it changes there | why "
        "|\n|---|---|---|---|---|---|\n{}\n"
        "{}\n\n"
        "Byte for byte: claims, counters, surfaces, depths, colours and figures.\n\n"
        "| fault | of | why |\n|---|---|---|\n{}",
        catalogue.size(), tried_width, tried_height, table_of(limits), caught_heading, count,
        caught, escaped_heading, escaped, without_effect_heading, without_effect);
}

bool holds(const std::string& file, int part) {
    const std::span<const Fault> catalogue = faults::all_faults();
    const Page page = read_page(file);
    const std::vector<Limit> limits = limits_of_page(file);
    /// A fault, of a size or of none, the technique that it is tried with, and what is to happen.
    struct Told {
        std::size_t fault;
        int power;
        std::string technique;
        bool caught;
    };
    std::map<std::string, std::vector<Told>> by_scene;
    const auto add = [&](std::size_t fault, int power, const std::string& place, bool caught) {
        const std::size_t slash = place.find('/');
        by_scene[place.substr(0, slash)].push_back({fault, power, place.substr(slash + 1), caught});
    };
    bool all = is_complete(page);
    for (const Limit& limit : limits) {
        const Fault& fault = catalogue[static_cast<std::size_t>(limit.number)];
        add(static_cast<std::size_t>(limit.number), limit.smallest, limit.finding.place, true);
        if (limit.smallest <= fault.aim) continue;
        fmt::print("{}: caught from 2^{} on, and aimed at is 2^{}\n", fault.name, limit.smallest,
                   fault.aim);
        all = false;
    }
    for (const Row& row : page.caught)
        if (const auto number = number_of(row.fault)) add(*number, 0, row.place, true);
    for (const Row& row : page.escaped)
        if (const auto number = number_of(row.fault)) add(*number, 0, row.place, false);
    const auto scaled = static_cast<std::size_t>(std::ranges::count_if(catalogue, is_scaled));
    std::size_t as_told = 0;
    Gpu gpu(GlPlatform::osmesa);
    for (const auto& [scene, those] : by_scene) {
        Trial trial(load_to_try(scene), gpu);
        for (const Told& told : those) {
            const Technique* technique = find_technique(told.technique);
            Outcome outcome;
            if (technique != nullptr)
                trial.run(static_cast<int>(told.fault), *technique, outcome, std::exp2(told.power));
            if (told.caught ? outcome.caught.has_value() : outcome.escaped.has_value())
                ++as_told;
            else
                fmt::print("{} is not {} on {}/{}\n", catalogue[told.fault].name,
                           told.caught ? "caught" : "without being caught effective", scene,
                           told.technique);
        }
    }
    std::vector<std::size_t> idle;
    for (std::size_t i = 0; i < page.without_effect.size(); ++i)
        if (static_cast<int>(i) % idle_parts == part)
            if (const auto number = number_of(page.without_effect[i].fault))
                idle.push_back(*number);
    all = are_without_effect(idle, gpu) && all;
    const std::size_t rows = page.caught.size() + page.escaped.size() + limits.size();
    fmt::print("{} of {} rows are as told, {} of {} limits stand, {} of {} faults without effect "
               "were tried (part {} of {})\n",
               as_told, rows, limits.size(), scaled, idle.size(), page.without_effect.size(),
               part + 1, idle_parts);
    return all && as_told == rows && limits.size() == scaled;
}

} // namespace shadowproof
