#include "compare/command/check/run_controls.h"

#include "compare/cell.h"
#include "compare/families.h"
#include "compare/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

std::string why_not_caught(const Control& control, const FaultyFrame& faulty) {
    if (faulty.changed == 0)
        return control.control == "caster_missing"
                   ? "no shadow that it throws alone is in this view"
                   : "it changes no pixel of this view";
    if (faulty.told == 0)
        return fmt::format("the picture tells light from shadow at none of the {} that it changes",
                           counted(faulty.changed, "pixel"));
    return fmt::format("the {} that it changes lie at edges, where either is right",
                       counted(faulty.told, "pixel"));
}

ControlOutcome run_control(const TracedScene& traced, const Frame& own, const Gate& gate,
                           const Control& control) {
    const FaultyFrame faulty = faulty_frame(traced, own, control);
    Cell cell;
    cell.comparison = classify(traced, faulty.frame, *judge_of(traced, faulty.frame));
    ControlOutcome outcome{.control = control.control,
                           .words = control.words,
                           .changed = faulty.changed,
                           .wrong = pixels_of(cell.comparison, Cause::unexplained),
                           .caught = fails(cell, gate),
                           .why_not = {}};
    if (!outcome.caught) outcome.why_not = why_not_caught(control, faulty);
    return outcome;
}

const ControlOutcome* smallest_caught(const std::vector<ControlOutcome>& outcomes) {
    const ControlOutcome* smallest = nullptr;
    for (const ControlOutcome& outcome : outcomes)
        if (outcome.caught && (smallest == nullptr || outcome.wrong < smallest->wrong))
            smallest = &outcome;
    return smallest;
}

} // namespace

std::vector<ControlOutcome> run_controls(const TracedScene& traced, const Frame& own,
                                         const Gate& gate) {
    std::vector<ControlOutcome> outcomes;
    for (const Control& control : controls_of(traced))
        outcomes.push_back(run_control(traced, own, gate, control));
    return outcomes;
}

nlohmann::ordered_json controls_json(const std::vector<ControlOutcome>& outcomes) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ControlOutcome& outcome : outcomes) {
        list.push_back({{"control", outcome.control},
                        {"words", outcome.words},
                        {"changed", outcome.changed},
                        {"wrong", outcome.wrong},
                        {"caught", outcome.caught}});
        if (!outcome.caught) list.back()["why_not"] = outcome.why_not;
    }
    return list;
}

std::vector<std::string> controls_lines(const std::vector<ControlOutcome>& outcomes) {
    std::vector<std::string> lines;
    for (const ControlOutcome& outcome : outcomes)
        lines.push_back(outcome.caught ? fmt::format("control: caught: {}, by {}", outcome.words,
                                                     counted(outcome.wrong, "pixel"))
                                       : fmt::format("control: not caught: {}: {}", outcome.words,
                                                     outcome.why_not));
    const auto caught = static_cast<std::uint64_t>(
        std::count_if(outcomes.begin(), outcomes.end(),
                      [](const ControlOutcome& outcome) { return outcome.caught; }));
    std::string words = fmt::format("controls: {} of {} caught", caught, outcomes.size());
    if (const ControlOutcome* smallest = smallest_caught(outcomes))
        words += fmt::format("; the smallest: {}, {}", smallest->words,
                             counted(smallest->wrong, "pixel"));
    lines.push_back(words);
    return lines;
}

} // namespace shadowproof
