#include "compare/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

bool fails(const Cell& cell, Gate gate) {
    if (!cell.error.empty()) return true;
    const std::uint64_t edge = cell.comparison.causes[static_cast<std::size_t>(Cause::edge)];
    if (gate == Gate::differences && cell.comparison.differing != edge) return true;
    return cell.verdict == Verdict::defect || cell.verdict == Verdict::unexplained;
}

bool fails(const SceneResult& scene, Gate gate) {
    return !scene.error.empty() || !scene.no_longer_provoked.empty() ||
           std::any_of(scene.cells.begin(), scene.cells.end(),
                       [&](const Cell& cell) { return fails(cell, gate); });
}

std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
    return digits;
}

std::string cause_counts(const Comparison& comparison) {
    std::string counts;
    for (const CauseWords& words : all_causes) {
        const std::uint64_t pixels = comparison.causes[static_cast<std::size_t>(words.cause)];
        if (pixels == 0) continue;
        if (!counts.empty()) counts += ", ";
        counts += fmt::format("{} {}", words.name, grouped(pixels));
    }
    return counts;
}

std::string cell_line(const SceneResult& scene, const Cell& cell, const ColumnWidths& widths) {
    const std::string_view verdict = cell.error.empty() ? name_of(cell.verdict) : "error";
    std::string line = fmt::format("{:<{}}  {:<{}}  {:<{}}  ", cell.technique, widths.technique,
                                   scene.name, widths.scene, verdict, widths.verdict);
    if (!cell.error.empty()) return line + cell.error;

    const Comparison& comparison = cell.comparison;
    const auto pixels =
        static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
    const std::string all = grouped(pixels);
    line += fmt::format("{:>{}} of {}", grouped(comparison.differing),
                        widths.technique == 0 ? 0 : all.size(), all);
    if (comparison.differing > 0) line += fmt::format(" ({})", cause_counts(comparison));
    if (comparison.first)
        line += fmt::format("  first ({},{}) {}", comparison.first->x, comparison.first->y,
                            name_of(comparison.first->cause));
    if (comparison.ledger.unexplained > 0)
        line += fmt::format("  counter unexplained at {}, first ({},{})",
                            grouped(comparison.ledger.unexplained), comparison.ledger.first_x,
                            comparison.ledger.first_y);
    return line + fmt::format("  {:.1f} ms", cell.milliseconds);
}

namespace {

/// As it stands where no shell gives a character a meaning, else in single quotes.
std::string shell_quoted(const std::string& word) {
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("_-./,:=+@%").find(c) != std::string_view::npos;
    });
    if (plain) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

} // namespace

std::string reproducing_command(const Report& report, const SceneResult& scene, const Cell& cell) {
    std::string command = "shadowproof verify " +
                          shell_quoted(scene.argument.empty() ? scene.name : scene.argument) +
                          " --technique " + cell.technique;
    for (const std::string& argument : report.arguments) command += " " + shell_quoted(argument);
    return command;
}

} // namespace shadowproof
