#include "compare/picture/picture_results.h"

#include "compare/json/json_rules.h"

namespace shadowproof {

using namespace json_rules;

namespace {

void hypothesis(const JsonPlace& place) {
    object(place, {{"hypothesis", some_text},
                   {"explained", count},
                   {"contradicted", count},
                   {"words", text}});
}

void region(const JsonPlace& place) {
    object(place, {{"pixels", size},
                   {"left", count},
                   {"top", count},
                   {"right", count},
                   {"bottom", count},
                   {"receiver", text},
                   {"caster", text},
                   {"words", some_text}});
}

void control(const JsonPlace& place) {
    object(place, {{"control", some_text},
                   {"words", text},
                   {"changed", count},
                   {"wrong", count},
                   {"caught", boolean},
                   {"why_not", some_text, Need::optional}});
}

} // namespace

void check_picture_results(const JsonPlace& cell) {
    object(cell, {{"falsely_lit", count},
                  {"falsely_shadowed", count},
                  {"undecidable", count},
                  {"diagnosis", list_of<hypothesis>, Need::optional},
                  {"regions", list_of<region>, Need::optional},
                  {"controls", list_of<control>, Need::optional}});
}

} // namespace shadowproof
