#include "compare/escape.h"
#include "compare/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace shadowproof {

std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
    return digits;
}

std::string counted(std::uint64_t number, std::string_view thing) {
    return fmt::format("{} {}{}", grouped(number), thing, number == 1 ? "" : "s");
}

std::string_view outcome_name(const Cell& cell) {
    return could_not_run(cell) ? "error" : name_of(cell.verdict);
}

std::string cause_counts(const CausePixels& causes) {
    std::string counts;
    for (const CauseWords& words : all_causes) {
        const std::uint64_t pixels = causes[static_cast<std::size_t>(words.cause)];
        if (pixels == 0) continue;
        if (!counts.empty()) counts += ", ";
        counts += fmt::format("{} {}", words.name, grouped(pixels));
    }
    return counts;
}

std::string cell_line(const SceneResult& scene, const Cell& cell, const ColumnWidths& widths) {
    const std::string_view verdict = outcome_name(cell);
    std::string line = fmt::format("{:<{}}  {:<{}}  {:<{}}  ", cell.technique, widths.technique,
                                   scene.name, widths.scene, verdict, widths.verdict);
    if (!cell.error.empty()) return line + cell.error;

    const Comparison& comparison = cell.comparison;
    const auto pixels =
        static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
    const std::string all = grouped(pixels);
    line += fmt::format("{:>{}} of {}", grouped(comparison.differing),
                        widths.technique == 0 ? 0 : all.size(), all);
    if (comparison.differing > 0) line += fmt::format(" ({})", cause_counts(comparison.causes));
    if (comparison.first)
        line += fmt::format("  first ({},{}) {}", comparison.first->x, comparison.first->y,
                            name_of(comparison.first->cause));
    if (comparison.ledger.unexplained > 0)
        line += fmt::format("  counter or surface unexplained at {}, first ({},{})",
                            grouped(comparison.ledger.unexplained), comparison.ledger.first_x,
                            comparison.ledger.first_y);
    if (comparison.colors) line += "  " + words_of(*comparison.colors);
    if (cell.saved) line += "  " + words_of(*cell.saved, cell.volume_fragments);
    return line + fmt::format("  {:.1f} ms", cell.milliseconds);
}

std::string words_of(const ColorCheck& colors) {
    std::string words =
        fmt::format("colour off by {:.2f}/255 at most (rmse {:.2f}, 99.9 % within {:.2f})",
                    colors.largest, colors.rmse, colors.percentile999);
    if (colors.unforeseen > 0)
        words += fmt::format(", unexplained at {}, first ({},{})", grouped(colors.unforeseen),
                             colors.first_unforeseen_x, colors.first_unforeseen_y);
    return words;
}

std::string words_of(const Savings& saved, std::uint64_t volume_fragments) {
    const std::int64_t fragments = saved.volume_fragments;
    const std::uint64_t all = volume_fragments + static_cast<std::uint64_t>(fragments);
    return fmt::format("saved {:.1f} ms and {}{} of {} volume fragments against {}",
                       saved.milliseconds, fragments < 0 ? "-" : "",
                       grouped(static_cast<std::uint64_t>(std::abs(fragments))), grouped(all),
                       saved.against);
}

std::string why_it_fails(const Cell& cell, const Gate& gate) {
    if (!cell.error.empty()) return cell.error;
    const Comparison& comparison = cell.comparison;
    std::string words = comparison.differing == 0 ? "no pixel of the claim differs"
                                                  : cause_counts(comparison.causes);
    const std::optional<FirstDifference>& first =
        cell.first_failing ? cell.first_failing : comparison.first;
    if (first)
        words += fmt::format("; first ({},{}) {}", first->x, first->y, name_of(first->cause));
    if (comparison.ledger.unexplained > 0)
        words += fmt::format("; counter or surface unexplained at {}, first ({},{})",
                             counted(comparison.ledger.unexplained, "pixel"),
                             comparison.ledger.first_x, comparison.ledger.first_y);
    if (comparison.colors && comparison.colors->unforeseen > 0)
        words += "; " + words_of(*comparison.colors);
    if (cell.since) words += "; since the baseline: " + words_of(*cell.since);
    const std::string allowed = cause_counts(pixels_allowed(cell, gate));
    return allowed.empty() ? words : words + "; allowed: " + allowed;
}

std::string no_longer_provoked_words(const SceneResult& scene) {
    return fmt::format("no technique shows {} any more, which the scene declares",
                       fmt::join(scene.no_longer_provoked, ", "));
}

namespace {

std::string command_for(const Report& report, const SceneResult& scene,
                        const std::string& technique) {
    std::string command = "shadowproof verify " +
                          shell_quoted(scene.argument.empty() ? scene.name : scene.argument) +
                          technique;
    if (scene.one_of_many) command += " --light " + shell_quoted(scene.light.choice);
    for (const std::string& argument : report.arguments) command += " " + shell_quoted(argument);
    return command;
}

} // namespace

std::string reproducing_command(const Report& report, const SceneResult& scene, const Cell& cell) {
    return command_for(report, scene, " --technique " + cell.technique);
}

std::string reproducing_command(const Report& report, const SceneResult& scene) {
    return command_for(report, scene, "");
}

} // namespace shadowproof
