#include "compare/stress/stress_table.h"

#include "compare/stress/breaking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace shadowproof {

namespace {

std::string listed(const std::vector<std::string>& names) {
    std::string words;
    for (const std::string& name : names) words += (words.empty() ? "" : ", ") + name;
    return words;
}

/// How far from its own value a parameter was taken, in factors.
double outwards(const Breaking& breaking, double own) {
    if (!breaking.fails || *breaking.fails <= 0 || own <= 0) return 1e300;
    return std::abs(std::log(*breaking.fails / own));
}

double own_value(const StressAlong& along) {
    for (const StressPoint& point : along.points)
        if (point.own) return point.value;
    return 1;
}

/// What is derived, in words; empty where nothing is.
std::string derived_words(const Breaking& breaking) {
    return breaking.derived ? "derived " + value_words(*breaking.derived) : std::string();
}

/// Those of one side, a line for those that break at the same value by the same cause, and are
/// derived to break at the same value.
void add_side(const StressAlong& along, bool up, std::vector<std::string>& lines) {
    const double own = own_value(along);
    using Key = std::tuple<double, double, double, std::string, std::string>;
    std::map<Key, std::vector<std::string>> broken;
    std::map<std::string, std::vector<std::string>> holding; // by what is derived
    double farthest = own;
    for (const StressPoint& point : along.points)
        if (up ? point.value > farthest : point.value < farthest) farthest = point.value;
    for (const Breaking& each : along.breaking) {
        if (each.up != up) continue;
        const std::string derived = derived_words(each);
        if (each.fails)
            broken[{outwards(each, own), *each.fails, each.holds, each.cause, derived}].push_back(
                each.technique);
        else
            holding[derived].push_back(each.technique);
    }
    for (const auto& [key, techniques] : broken) {
        const auto& [far, fails, holds, cause, derived] = key;
        lines.push_back(fmt::format("    {:<9}  {:<14}  {}  (holds at {}{})", value_words(fails),
                                    cause, listed(techniques), value_words(holds),
                                    derived.empty() ? "" : ", " + derived));
    }
    for (const auto& [derived, techniques] : holding)
        lines.push_back(fmt::format("    {:<9}  {:<14}  {}{}", value_words(farthest), "hold",
                                    listed(techniques),
                                    derived.empty() ? "" : "  (" + derived + ")"));
}

} // namespace

std::string value_words(double value) {
    return fmt::format("{:.3g}", value);
}

std::vector<std::string> stress_table(const StressAlong& along) {
    std::vector<std::string> lines;
    lines.push_back(fmt::format("  {}: {}", along.parameter, along.words));
    add_side(along, false, lines);
    add_side(along, true, lines);
    if (!along.wrong_before.empty())
        lines.push_back(fmt::format("    {:<9}  {:<14}  {}", value_words(own_value(along)),
                                    "wrong as it is", listed(along.wrong_before)));
    for (const StressPoint& point : along.points) {
        const std::string value = value_words(point.value);
        if (!point.refused.empty())
            lines.push_back(
                fmt::format("    {:<9}  {:<14}  {}", value, refusal(point.loss), point.refused));
        // Elsewhere it is a breaking point, whose cause says so.
        for (const StressCell& cell : point.cells)
            if (point.own && !cell.refused.empty())
                lines.push_back(
                    fmt::format("    {:<9}  {:<14}  {}", value, refusal(cell.loss), cell.refused));
    }
    return lines;
}

} // namespace shadowproof
