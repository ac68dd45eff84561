#include "compare/stress/breaking.h"

#include "compare/bench/bench_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace shadowproof {

bool has_failed(const StressCell& cell) {
    return !cell.refused.empty() || wrong_pixels(cell.error) > 0 ||
           cell.verdict == Verdict::unexplained;
}

StressTally tally_of(const StressRun& run) {
    StressTally tally;
    for (const StressScene& scene : run.scenes)
        for (const StressAlong& along : scene.parameters)
            for (const StressPoint& point : along.points) {
                if (!point.refused.empty()) continue;
                ++tally.points;
                tally.asked += point.witness.asked;
                tally.disagreements += point.witness.disagreements;
                tally.relations_tried += point.relations.tried.size();
                tally.changed += point.relations.changed;
                for (const StressCell& cell : point.cells) {
                    ++tally.cells;
                    tally.unexplained +=
                        cell.refused.empty() && cell.verdict == Verdict::unexplained ? 1 : 0;
                }
            }
    return tally;
}

std::optional<double> value_between(double holds, double fails, bool whole) {
    if (holds <= 0 || fails <= 0) return std::nullopt;
    const double more = std::max(holds, fails);
    const double less = std::min(holds, fails);
    if (more <= 1.1 * less) return std::nullopt;
    // Square roots apart: products of the ends of the range of doubles are none.
    const double between = std::sqrt(holds) * std::sqrt(fails);
    const double value =
        whole ? std::round(between) : std::strtod(fmt::format("{:.3g}", between).c_str(), nullptr);
    if (value <= less || value >= more) return std::nullopt;
    return value;
}

std::string refusal(Loss loss) {
    return loss == Loss::none ? "refused" : std::string(name_of(loss));
}

namespace {

std::string main_cause(const StressCell& cell) {
    if (!cell.refused.empty()) return refusal(cell.loss);
    std::string cause;
    std::uint64_t most = 0;
    for (const auto& [name, pixels] : cell.error.causes)
        if (name != "edge" && pixels > most) {
            cause = name;
            most = pixels;
        }
    return cause.empty() ? "unexplained" : cause;
}

const StressCell* find_cell(const StressPoint& point, const std::string& technique) {
    const auto found = std::ranges::find(point.cells, technique, &StressCell::technique);
    return found == point.cells.end() ? nullptr : &*found;
}

/// Where strains reach 1 from the own value outwards.
void add_derived(const StressPoint& own, const std::vector<const StressPoint*>& side,
                 Breaking& breaking) {
    breaking.derived_holds = own.value;
    const StressCell* const as_it_is = find_cell(own, breaking.technique);
    if (!as_it_is->strain || *as_it_is->strain >= 1) return;
    for (const StressPoint* point : side) {
        const StressCell* const there = find_cell(*point, breaking.technique);
        if (there == nullptr || !there->strain) continue;
        if (*there->strain >= 1) {
            breaking.derived = point->value;
            return;
        }
        breaking.derived_holds = point->value;
    }
}

} // namespace

std::vector<Breaking> breaking_points(const StressAlong& along, bool up) {
    const auto own = std::ranges::find(along.points, true, &StressPoint::own);
    if (own == along.points.end()) return {};
    std::vector<const StressPoint*> side; // from the own value outwards
    for (const StressPoint& point : along.points)
        if (up ? point.value > own->value : point.value < own->value) side.push_back(&point);
    if (!up) std::ranges::reverse(side);
    if (side.empty()) return {};
    std::vector<Breaking> all;
    for (const StressCell& cell : own->cells) {
        if (has_failed(cell)) continue;
        Breaking breaking{
            .technique = cell.technique, .up = up, .holds = own->value, .fails = {}, .derived = {}};
        for (const StressPoint* point : side) {
            const StressCell* const there = find_cell(*point, cell.technique);
            if (!point->refused.empty()) {
                breaking.fails = point->value;
                breaking.cause = refusal(point->loss);
                breaking.refused = true;
                break;
            }
            if (there == nullptr) continue;
            if (!has_failed(*there)) {
                breaking.holds = point->value;
                continue;
            }
            breaking.fails = point->value;
            breaking.cause = main_cause(*there);
            breaking.refused = !there->refused.empty();
            break;
        }
        add_derived(*own, side, breaking);
        all.push_back(std::move(breaking));
    }
    return all;
}

std::optional<Search> next_search(const std::vector<Breaking>& breaking, bool whole) {
    std::optional<Search> search;
    const auto add = [&](const std::string& technique, double holds, double fails) {
        const std::optional<double> value = value_between(holds, fails, whole);
        if (!value) return;
        if (!search) search = Search{*value, {}};
        if (*value == search->value) search->techniques.push_back(technique);
    };
    for (const Breaking& each : breaking)
        if (each.fails && !each.refused) add(each.technique, each.holds, *each.fails);
    if (search) return search;
    for (const Breaking& each : breaking)
        if (each.derived) add(each.technique, each.derived_holds, *each.derived);
    return search;
}

} // namespace shadowproof
