#include "tests/sensitivity/limits.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <regex>
#include <span>
#include <string_view>

namespace shadowproof {

namespace {

using faults::Fault;

/// Smaller than any float tells from nothing.
constexpr int least_power = -60;

const Fault& fault_of(const Limit& limit) {
    return faults::all_faults()[static_cast<std::size_t>(limit.number)];
}

/// "2^-7 (0.0078)"
std::string size_of(int power) {
    return fmt::format("2^{} ({:.2g})", power, std::exp2(power));
}

} // namespace

bool is_scaled(const Fault& fault) {
    return fault.largest != 0;
}

std::vector<Limit> limits_of(const std::vector<std::uint8_t>& chosen) {
    std::vector<Limit> limits;
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (chosen[i] != 0 && is_scaled(faults::all_faults()[i]))
            limits.push_back({.number = static_cast<int>(i), .finding = {}});
    return limits;
}

void lower(std::vector<Limit>& limits, Trial& trial) {
    for (Limit& limit : limits)
        for (const Technique& technique : all_techniques()) {
            if (!concerns(fault_of(limit), technique, trial.scene())) continue;
            int power = limit.smallest == 0 ? fault_of(limit).largest : limit.smallest - 1;
            for (; power >= least_power; --power) {
                Outcome outcome;
                trial.run(limit.number, technique, outcome, std::exp2(power));
                if (!outcome.caught) break;
                limit.smallest = power;
                limit.finding = *outcome.caught;
            }
        }
}

std::string table_of(const std::vector<Limit>& limits) {
    std::string table;
    for (const Limit& limit : limits) {
        const Fault& fault = fault_of(limit);
        table += fmt::format("| `{}` | {} | {} | `{}` | {} | {} |\n", fault.name, fault.unit,
                             limit.smallest == 0 ? "none" : size_of(limit.smallest),
                             limit.finding.place, limit.finding.effect, fault.own);
    }
    return table;
}

std::vector<Limit> limits_of_page(const std::string& file) {
    std::ifstream stream(file);
    const std::span<const Fault> catalogue = faults::all_faults();
    std::vector<Limit> limits;
    const std::regex row(R"(\| `(\w+)` \| [^|]+ \| 2\^(-\d+) [^|]+ \| `([^`]+)` \| .*)");
    std::smatch match;
    for (std::string line; std::getline(stream, line);) {
        if (!std::regex_match(line, match, row)) continue;
        for (std::size_t i = 0; i < catalogue.size(); ++i)
            if (catalogue[i].name == match[1].str())
                limits.push_back({.number = static_cast<int>(i),
                                  .smallest = std::stoi(match[2]),
                                  .finding = {.place = match[3]}});
    }
    return limits;
}

} // namespace shadowproof
