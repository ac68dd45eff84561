#include "compare/command/worst_cells.h"

#include <algorithm>
#include <tuple>

namespace shadowproof {

namespace {

constexpr std::size_t most_lines = 5;
constexpr std::size_t cells_in_sight = 20; ///< a terminal has at least 24 rows

struct RankedCell {
    const SceneResult* scene = nullptr;
    const Cell* cell = nullptr;
    bool failing = false;
    std::uint64_t wrong_pixels = 0; ///< without those at edges

    auto rank() const { return std::tuple(failing, wrong_pixels); }
};

std::uint64_t wrong_pixels_of(const Comparison& comparison) {
    return comparison.differing - comparison.causes[static_cast<std::size_t>(Cause::edge)];
}

} // namespace

std::vector<std::string> worst_cells(const Report& report) {
    std::size_t cells = 0;
    std::vector<RankedCell> ranked;
    for (const SceneResult& scene : report.scenes)
        for (const Cell& cell : scene.cells) {
            ++cells;
            const RankedCell one{&scene, &cell, fails(cell, report.gate),
                                 wrong_pixels_of(cell.comparison)};
            if (one.failing || one.wrong_pixels > 0) ranked.push_back(one);
        }
    if (report.scenes.size() < 2 || cells <= cells_in_sight) return {};
    // Equal ones stay in the order of the run.
    std::ranges::stable_sort(ranked, std::ranges::greater(), &RankedCell::rank);
    ranked.resize(std::min(ranked.size(), most_lines));
    ColumnWidths widths;
    for (const RankedCell& one : ranked) {
        const auto widen = [](int& width, std::size_t size) {
            width = std::max(width, static_cast<int>(size));
        };
        widen(widths.technique, one.cell->technique.size());
        widen(widths.scene, one.scene->name.size());
        widen(widths.verdict, outcome_name(*one.cell).size());
    }
    std::vector<std::string> lines;
    for (const RankedCell& one : ranked) lines.push_back(cell_line(*one.scene, *one.cell, widths));
    return lines;
}

} // namespace shadowproof
