#include "compare/maps/map_results.h"

#include "compare/json/json_rules.h"

namespace shadowproof {

using namespace json_rules;

namespace {

void map(const JsonPlace& place) {
    object(place, {{"size", size},
                   {"bias", number},
                   {"value", text},
                   {"format", text},
                   {"culling", text},
                   {"near", number},
                   {"far", number},
                   {"texels", count},
                   {"texels_unexplained", count},
                   {"straddling", count},
                   {"slope_bias", number, Need::optional},
                   {"offset_units", number, Need::optional},
                   {"filter", size, Need::optional},
                   {"average", text, Need::optional},
                   {"edges", text, Need::optional},
                   {"ms", milliseconds}});
}

} // namespace

void check_map_results(const JsonPlace& cell) {
    object(cell, {{"map", map}});
}

} // namespace shadowproof
