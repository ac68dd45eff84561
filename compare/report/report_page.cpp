#include "compare/report/report_page.h"

#include "compare/report/report_legend.h"
#include "compare/report/report_template.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

std::string css_color(const Rgb& color) {
    return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

/// Names, meanings and colours of causes and contradictions, and the dimmed colours of claims, so
/// that the viewer has none of its own.
Json legend() {
    Json legend{{"causes", Json::array()}, {"contradictions", Json::array()}};
    for (std::size_t i = 0; i < all_causes.size(); ++i)
        legend["causes"].push_back({{"name", all_causes[i].name},
                                    {"meaning", all_causes[i].meaning},
                                    {"color", css_color(cause_colors[i])}});
    for (const ContradictionWords& words : all_contradictions)
        legend["contradictions"].push_back(
            {{"name", words.name}, {"meaning", words.meaning}, {"color", css_color(words.color)}});
    for (const Visibility claim :
         {Visibility::background, Visibility::shadowed, Visibility::partly_lit, Visibility::lit})
        legend["dimmed"][fmt::format("{}", static_cast<int>(claim))] = css_color(dimmed(claim));
    return legend;
}

} // namespace

std::string report_page() {
    return fill(viewer_file("page.html"),
                {{"style", viewer_style()},
                 {"script", viewer_script()},
                 {"legend", "shadowproof.legend(" + legend().dump(1) + ");"}});
}

} // namespace shadowproof
