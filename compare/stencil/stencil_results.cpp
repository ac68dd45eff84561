#include "compare/stencil/stencil_results.h"

#include "compare/json/json_rules.h"

namespace shadowproof {

using namespace json_rules;

namespace {

void ledger(const JsonPlace& place) {
    object(place, {{"equal", count}, {"in_band", count}, {"unexplained", count}});
}

void figure(const JsonPlace& place) {
    object(place, {{"shown", count}, {"low", count}, {"high", count}});
}

void wrong_faces(const JsonPlace& place) {
    object(place, {{"x", count}, {"y", count}, {"faces", figure}});
}

void volumes(const JsonPlace& place) {
    object(place, {{"checked", count},
                   {"unexplained", count},
                   {"fragments", figure},
                   {"against", figure, Need::optional},
                   {"first", wrong_faces, Need::optional},
                   {"words", some_text, Need::optional}});
}

void saved(const JsonPlace& place) {
    object(place, {{"against", text},
                   {"ms", number},
                   {"volume_fragments", whole_number},
                   {"plan_ms", number, Need::optional}});
}

void require_figure(const JsonPlace& figure, std::int64_t shown, const char* what) {
    require(figure.value.at("shown") == shown, figure.at("shown"),
            fmt::format("{}, {}", shown, what));
    require(figure.value.at("low").get<std::uint64_t>() <=
                figure.value.at("high").get<std::uint64_t>(),
            figure, "no range whose low end is above its high one");
}

/// Checks that figures compared with predictions are the cell's own.
void check_volumes(const JsonPlace& cell) {
    const JsonPlace volumes = cell.at("volumes");
    const auto fragments = cell.value.at("volume_fragments").get<std::int64_t>();
    const auto pixels = cell.value.at("pixels").get<std::uint64_t>();
    require(volumes.value.at("checked") == pixels, volumes.at("checked"),
            fmt::format("{}, the pixels of the cell", pixels));
    require_figure(volumes.at("fragments"), fragments, "the cell's own \"volume_fragments\"");
    require(volumes.value.contains("first") ==
                (volumes.value.at("unexplained").get<std::uint64_t>() > 0),
            volumes, "\"first\" where pixels are unexplained, and only there");
    if (!cell.value.contains("saved") || !volumes.value.contains("against")) return;
    const auto saved = cell.value.at("saved").at("volume_fragments").get<std::int64_t>();
    require_figure(volumes.at("against"), fragments + saved, "what the cell has and has saved");
}

} // namespace

void check_stencil_results(const JsonPlace& cell) {
    object(cell, {{"volume_fragments", count},
                  {"saved", saved, Need::optional},
                  {"ledger", ledger},
                  {"volumes", volumes}});
    require_sum(cell.at("ledger"),
                sum(cell.value.at("ledger"), {"equal", "in_band", "unexplained"}),
                cell.value.at("pixels").get<std::uint64_t>(), "\"pixels\"");
    check_volumes(cell);
}

} // namespace shadowproof
