#include "compare/traced/traced_results.h"

#include "compare/json/json_rules.h"

namespace shadowproof {

using namespace json_rules;

namespace {

void rays(const JsonPlace& place) {
    object(place, {{"shadow", count}, {"as_traced_exactly", count}, {"unexplained", count}});
}

} // namespace

void check_traced_results(const JsonPlace& cell) {
    object(cell, {{"rays", rays}});
    require_sum(cell.at("rays"), sum(cell.value.at("rays"), {"as_traced_exactly", "unexplained"}),
                cell.value.at("pixels").get<std::uint64_t>(), "\"pixels\"");
}

} // namespace shadowproof
