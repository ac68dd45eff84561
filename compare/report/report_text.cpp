#include "compare/evidence.h"
#include "compare/report/escape.h"
#include "compare/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace shadowproof {

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

std::string excused_words(const Cell& cell, const Gate& gate) {
    if (gate.on != GateOn::defects) return {};
    std::uint64_t pixels = 0;
    std::string names;
    for (const Cause cause : cell.excused) {
        const std::uint64_t found = cell.comparison.causes[static_cast<std::size_t>(cause)];
        if (found == 0) continue;
        pixels += found;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(cause));
    }
    if (pixels == 0) return {};
    return fmt::format("{} excused: {} is known for {}", counted(pixels, "wrong pixel"),
                       cell.technique, names);
}

namespace {

/// "3 of precision where the technique's numbers suffice"; empty where there are none.
std::string too_near_words(const Comparison& comparison) {
    if (comparison.too_near == 0) return {};
    return fmt::format("{} of precision where the technique's numbers suffice",
                       grouped(comparison.too_near));
}

} // namespace

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
    if (const std::string near = too_near_words(comparison); !near.empty()) line += "  " + near;
    for (const std::string& clause : unexplained_evidence(comparison)) line += "  " + clause;
    if (comparison.colors) line += "  " + words_of(*comparison.colors);
    if (!comparison.summary.words.empty()) line += "  " + comparison.summary.words;
    return line + fmt::format("  {:.1f} ms", cell.milliseconds);
}

std::string words_of(const ColorCheck& colors) {
    std::string words =
        fmt::format("colour off{} by {:.2f}/255 at most (rmse {:.2f}, 99.9 % within {:.2f}; of the "
                    "whole picture rmse {:.2f})",
                    filters(colors.model) ? " the mean over the pixel" : "", colors.largest,
                    colors.rmse, colors.percentile999, colors.picture_rmse);
    for (const LightAdded& light : colors.lights_before)
        if (light.differing > 0)
            words += fmt::format(", with wrong shadows of {} at {}", light.name,
                                 counted(light.differing, "pixel"));
    return words;
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
    if (const std::string near = too_near_words(comparison); !near.empty()) words += "; " + near;
    for (const std::string& clause : unexplained_evidence(comparison)) words += "; " + clause;
    if (comparison.colors && comparison.colors->unpredicted > 0)
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
    if (!cell.command.empty()) {
        std::string command = "shadowproof";
        for (const std::string& word : cell.command) command += " " + shell_quoted(word);
        return command;
    }
    return command_for(report, scene, " --technique " + cell.technique);
}

std::string reproducing_command(const Report& report, const SceneResult& scene) {
    return command_for(report, scene, "");
}

} // namespace shadowproof
