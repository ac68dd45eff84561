#include "compare/report_html.h"

#include "compare/report_legend.h"
#include "compare/report_template.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

std::string_view verdict_class(const Cell& cell) {
    return cell.error.empty() ? name_of(cell.verdict) : std::string_view("error");
}

/// A mark and words, so that no verdict is told by colour alone.
struct VerdictWords {
    std::string_view mark;
    std::string_view words;
};
VerdictWords words_of(const Cell& cell) {
    if (!cell.error.empty()) return {"!", "could not run"};
    switch (cell.verdict) {
    case Verdict::agrees:
        return {"✓", "agrees"};
    case Verdict::fails_as_predicted:
        return {"≈", "fails as predicted"};
    case Verdict::defect:
        return {"✕", "defect"};
    case Verdict::unexplained:
        break;
    }
    return {"?", "unexplained"};
}

/// Failing first, then by how far a verdict is from agreeing.
int urgency(const Cell& cell, Gate gate) {
    const int verdict = cell.error.empty() ? static_cast<int>(cell.verdict) : 10;
    return fails(cell, gate) ? 20 + verdict : verdict;
}

template <class Item, class Key>
std::vector<const Item*> most_urgent_first(const std::vector<Item>& items, Key key) {
    std::vector<const Item*> sorted;
    for (const Item& item : items) sorted.push_back(&item);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](const Item* a, const Item* b) { return key(*a) > key(*b); });
    return sorted;
}

std::vector<const SceneResult*> scenes_in_order(const Report& report) {
    return most_urgent_first(report.scenes,
                             [&](const SceneResult& scene) { return fails(scene, report.gate); });
}

/// Ids and picture folders are the same: unique in the run, and plain characters.
std::string scene_id(const SceneResult& scene) {
    return std::filesystem::path(truth_path(scene)).parent_path().string();
}

std::string cell_id(const SceneResult& scene, const Cell& cell) {
    return scene_id(scene) + "." + cell.technique;
}

std::uint64_t beyond_edges(const Comparison& comparison) {
    return comparison.differing - comparison.causes[static_cast<std::size_t>(Cause::edge)];
}

std::string css_color(const Rgb& color) {
    return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::string fact(std::string_view term, const std::string& value) {
    if (value.empty()) return {};
    return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", term, escaped(value));
}

std::string list_of(std::string_view label, const std::vector<std::string>& items) {
    if (items.empty()) return {};
    std::string list = fmt::format("<p class=\"label\">{}</p>\n<ul class=\"remarks\">\n", label);
    for (const std::string& item : items) list += fmt::format("<li>{}</li>\n", escaped(item));
    return list + "</ul>\n";
}

std::string joined(const std::vector<std::string>& items) {
    return fmt::format("{}", fmt::join(items, ", "));
}

struct Picture {
    std::string file;
    std::string title;
    std::string caption;
    std::string alt;
};

/// `first` is ringed, beside the picture's own pixels and not in them.
std::string figure(const SceneResult& scene, const Picture& picture,
                   const std::optional<FirstDifference>& first = {}) {
    std::string ring;
    if (first)
        ring = fmt::format(
            "<span class=\"ring\" aria-hidden=\"true\" style=\"left:{:.3f}%;top:{:.3f}%\"></span>",
            100 * (first->x + 0.5) / scene.width, 100 * (first->y + 0.5) / scene.height);
    return fill(viewer_file("figure.html"), {{"file", picture.file},
                                             {"title", picture.title},
                                             {"caption", escaped(picture.caption)},
                                             {"alt", escaped(picture.alt)},
                                             {"width", std::to_string(scene.width)},
                                             {"height", std::to_string(scene.height)},
                                             {"ring", ring}});
}

std::string pictures(const SceneResult& scene, const Cell& cell) {
    const std::string& technique = cell.technique;
    const auto& first = cell.comparison.first;
    return "<div class=\"pictures\">\n" +
           figure(scene,
                  {truth_path(scene), "Truth", "White is lit, gray shadowed, black background.",
                   fmt::format("Truth of {}", scene.name)},
                  first) +
           figure(scene,
                  {picture_path(scene, cell, "claim"), "Claim", "What the technique says.",
                   fmt::format("What {} claims of {}", technique, scene.name)},
                  first) +
           figure(scene,
                  {picture_path(scene, cell, "difference"), "Difference",
                   "Differing pixels over the dimmed claim.",
                   fmt::format("Where {} differs from the truth of {}", technique, scene.name)},
                  first) +
           figure(scene,
                  {picture_path(scene, cell, "cause"), "Cause", "Why each pixel differs.",
                   fmt::format("Causes of the differing pixels of {} on {}: {}", technique,
                               scene.name, cause_counts(cell.comparison))},
                  first) +
           "</div>\n";
}

std::string legend_row(const Rgb& color, std::string_view name, const std::string& number,
                       std::string_view meaning) {
    return fmt::format("<tr><th scope=\"row\"><span class=\"swatch\" style=\"--color:{}\"></span>"
                       "{}</th>{}<td>{}</td></tr>\n",
                       css_color(color), name,
                       number.empty() ? "" : fmt::format("<td class=\"number\">{}</td>", number),
                       meaning);
}

std::string cause_legend(const Comparison& comparison) {
    std::string rows;
    for (std::size_t i = 0; i < all_causes.size(); ++i)
        if (comparison.causes[i] > 0)
            rows += legend_row(cause_colors[i], all_causes[i].name, grouped(comparison.causes[i]),
                               all_causes[i].meaning);
    return "<table class=\"legend\">\n<caption>Causes, in pixels</caption>\n" + rows + "</table>\n";
}

std::string contradiction_legend() {
    std::string rows;
    for (const ContradictionWords& words : all_contradictions)
        rows += legend_row(words.color, words.name, {}, words.meaning);
    return "<table class=\"legend\">\n<caption>Colours of the difference</caption>\n" + rows +
           "</table>\n";
}

/// The surroundings of the first differing pixel, eight to one.
std::string lenses(const SceneResult& scene, const Cell& cell) {
    const FirstDifference& first = *cell.comparison.first;
    const auto lens = [&](const char* title, const std::string& file) {
        return fmt::format("<li><div class=\"lens\" role=\"img\" aria-label=\"{0}, 15 by 15 pixels "
                           "around ({1}, {2})\" style=\"--x:{1};--y:{2};--w:{3};background-image:"
                           "url({4})\"></div><span>{0}</span></li>\n",
                           title, first.x, first.y, scene.width, file);
    };
    return fmt::format("<div>\n<p class=\"label\">First differing pixel: ({}, {}), {}</p>\n",
                       first.x, first.y, name_of(first.cause)) +
           "<ul class=\"lenses\">\n" + lens("Truth", truth_path(scene)) +
           lens("Claim", picture_path(scene, cell, "claim")) +
           lens("Difference", picture_path(scene, cell, "difference")) +
           lens("Cause", picture_path(scene, cell, "cause")) + "</ul>\n</div>\n";
}

std::string cell_body(const SceneResult& scene, const Cell& cell) {
    if (!cell.error.empty()) return fmt::format("<p class=\"alert\">{}</p>\n", escaped(cell.error));
    std::string body;
    const Comparison& comparison = cell.comparison;
    if (comparison.ledger.unexplained > 0)
        body += fmt::format("<p class=\"alert\">The counter read back is not the one predicted, "
                            "nor any in the band, at {} pixels; the first is ({}, {}).</p>\n",
                            grouped(comparison.ledger.unexplained), comparison.ledger.first_x,
                            comparison.ledger.first_y);
    body += pictures(scene, cell);
    if (comparison.first)
        body += "<div class=\"below\">\n" + lenses(scene, cell) + "<div>\n" +
                cause_legend(comparison) + "</div>\n<div>\n" + contradiction_legend() +
                "</div>\n</div>\n";
    return body;
}

std::string count_of(const SceneResult& scene, const Cell& cell) {
    if (!cell.error.empty()) return {};
    const auto pixels =
        static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
    const Comparison& comparison = cell.comparison;
    std::string count = grouped(comparison.differing) + " of " + grouped(pixels);
    if (comparison.differing > 0) count += " (" + cause_counts(comparison) + ")";
    return count;
}

std::string cell_section(const Report& report, const SceneResult& scene, const Cell& cell) {
    const VerdictWords words = words_of(cell);
    const bool open = fails(cell, report.gate) || cell.verdict != Verdict::agrees;
    return fill(viewer_file("cell.html"),
                {{"id", cell_id(scene, cell)},
                 {"verdict", std::string(verdict_class(cell))},
                 {"open", open ? " open" : ""},
                 {"technique", escaped(cell.technique)},
                 {"mark", std::string(words.mark)},
                 {"verdict_words", std::string(words.words)},
                 {"count", count_of(scene, cell)},
                 {"summary", escaped(cell.summary)},
                 {"body", cell_body(scene, cell)},
                 {"command", escaped(reproducing_command(report, scene, cell))}});
}

std::string scene_section(const Report& report, const SceneResult& scene) {
    std::string alert;
    if (!scene.error.empty())
        alert = fmt::format("<p class=\"alert\">{}</p>\n", escaped(scene.error));
    if (!scene.no_longer_provoked.empty())
        alert += fmt::format("<p class=\"alert\">This scene no longer provokes {}.</p>\n",
                             escaped(joined(scene.no_longer_provoked)));
    std::string facts = fact("File", scene.file);
    std::string truth;
    std::string cells;
    if (scene.error.empty()) {
        const TraceStatistics& traced = scene.truth.statistics;
        truth = figure(
            scene, {truth_path(scene), "Truth",
                    fmt::format("Lit {}, shadowed {}, background {} pixels.", grouped(traced.lit),
                                grouped(traced.shadowed), grouped(traced.background)),
                    fmt::format("Truth of {}", scene.name)});
        facts += fact("Size", fmt::format("{} × {}", scene.width, scene.height)) +
                 fact("Triangles", grouped(scene.triangles)) + fact("Light", scene.light) +
                 fact("Provokes", joined(scene.provokes)) +
                 fact("Decided in exact arithmetic", grouped(traced.exact_decisions));
        for (const Cell* cell : most_urgent_first(
                 scene.cells, [&](const Cell& each) { return urgency(each, report.gate); }))
            cells += cell_section(report, scene, *cell);
    }
    return fill(viewer_file("scene.html"),
                {{"id", scene_id(scene)},
                 {"name", escaped(scene.name)},
                 {"alert", alert},
                 {"truth", truth},
                 {"facts", facts},
                 {"remarks", list_of("Left out, as this scene does not need it", scene.left_out) +
                                 list_of("Notes", scene.notes)},
                 {"cells", cells}});
}

std::vector<std::string> techniques_of(const Report& report) {
    std::vector<std::string> names;
    for (const SceneResult& scene : report.scenes)
        for (const Cell& cell : scene.cells)
            if (std::find(names.begin(), names.end(), cell.technique) == names.end())
                names.push_back(cell.technique);
    return names;
}

std::string matrix_entry(const SceneResult& scene, const std::string& technique) {
    const auto cell = std::find_if(scene.cells.begin(), scene.cells.end(),
                                   [&](const Cell& each) { return each.technique == technique; });
    if (cell == scene.cells.end()) return "<td>–</td>";
    const VerdictWords words = words_of(*cell);
    return fmt::format("<td class=\"{}\"><a href=\"#{}\">{} {}<span>{}</span></a></td>",
                       verdict_class(*cell), cell_id(scene, *cell), words.mark, words.words,
                       cell->error.empty() ? grouped(beyond_edges(cell->comparison)) : "");
}

std::string matrix_rows(const Report& report, const std::vector<std::string>& techniques) {
    std::string rows;
    for (const SceneResult* scene : scenes_in_order(report)) {
        rows += fmt::format("<tr><th scope=\"row\"><a href=\"#{}\">{}</a></th>", scene_id(*scene),
                            escaped(scene->name));
        if (!scene->error.empty()) {
            rows += fmt::format("<td class=\"error\" colspan=\"{}\"><a href=\"#{}\">! could not "
                                "run</a></td>",
                                std::max<std::size_t>(1, techniques.size()), scene_id(*scene));
        } else {
            for (const std::string& technique : techniques) rows += matrix_entry(*scene, technique);
        }
        rows += "</tr>\n";
    }
    return rows;
}

std::string headline_of(const Report& report) {
    if (report.passed) return "Everything is as predicted";
    for (const SceneResult& scene : report.scenes) {
        if (!scene.error.empty()) return "Something could not run";
        for (const Cell& cell : scene.cells)
            if (!cell.error.empty()) return "Something could not run";
    }
    return "Something is wrong";
}

/// "20 cells of 4 scenes: 1 failing, 7 failing as predicted, ..."
std::string sentence_of(const Report& report) {
    std::size_t agree = 0;
    std::size_t predicted = 0;
    std::size_t failing = 0;
    std::size_t all = 0;
    for (const SceneResult& scene : report.scenes)
        for (const Cell& cell : scene.cells) {
            ++all;
            if (fails(cell, report.gate))
                ++failing;
            else if (cell.verdict == Verdict::agrees)
                ++agree;
            else
                ++predicted;
        }
    std::string sentence =
        fmt::format("{} {} of {} {}: ", all, all == 1 ? "cell" : "cells", report.scenes.size(),
                    report.scenes.size() == 1 ? "scene" : "scenes");
    if (failing > 0) sentence += fmt::format("{} failing, ", failing);
    return sentence + fmt::format("{} failing as predicted, {} without a difference beyond edges.",
                                  predicted, agree);
}

} // namespace

std::string to_html(const Report& report) {
    const std::vector<std::string> techniques = techniques_of(report);
    std::string heads;
    for (const std::string& technique : techniques)
        heads += fmt::format("<th scope=\"col\">{}</th>", escaped(technique));
    std::string scenes;
    for (const SceneResult* scene : scenes_in_order(report))
        scenes += scene_section(report, *scene);
    return fill(viewer_file("page.html"),
                {{"title", report.passed ? "shadowproof: passed" : "shadowproof: failed"},
                 {"style", std::string(viewer_file("style.css"))},
                 {"outcome", report.passed ? "passed" : "failed"},
                 {"version", escaped(report.version)},
                 {"headline", headline_of(report)},
                 {"sentence", sentence_of(report)},
                 {"techniques", heads},
                 {"rows", matrix_rows(report, techniques)},
                 {"scenes", scenes},
                 {"gl_version", escaped(report.gl.version)},
                 {"gl_renderer", escaped(report.gl.renderer)},
                 {"gl_bits", fmt::format("{}, {}, {}", report.gl.depth_bits, report.gl.stencil_bits,
                                         report.gl.subpixel_bits)},
                 {"embree", escaped(report.embree)},
                 {"gate", report.gate == Gate::defects ? "defects and unexplained pixels"
                                                       : "any difference beyond edges"}});
}

} // namespace shadowproof
