#include "compare/report/color_words.h"

#include "scenes/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

std::string words_of(const glm::dvec3& color) {
    return fmt::format("{:.4f} {:.4f} {:.4f}", color.x, color.y, color.z);
}

std::string words_of(const Intervals& color) {
    return fmt::format("{:.4f}..{:.4f} {:.4f}..{:.4f} {:.4f}..{:.4f}", color[0].low, color[0].high,
                       color[1].low, color[1].high, color[2].low, color[2].high);
}

std::string_view meaning_of(ColorVerdict verdict) {
    switch (verdict) {
    case ColorVerdict::as_shown:
        return "that of what it shows, which is background or not the truth's";
    case ColorVerdict::within:
        return "within the bound of what the error budget explains";
    case ColorVerdict::beyond:
        return "beyond the bound of what the error budget explains, as its arithmetic predicts";
    case ColorVerdict::unpredicted:
        return "not what its arithmetic predicts";
    case ColorVerdict::moved:
        return "more than 1/255 off, and right where the rasterizer may have drawn instead";
    case ColorVerdict::unexplained:
        break;
    }
    return "beyond the bound of what the error budget explains, and not what its arithmetic "
           "predicts";
}

double weight_of(const ColorAccount& account, ColorTerm term) {
    return account.weights[static_cast<std::size_t>(term)];
}

/// What moves the colour most comes first.
std::array<ColorTerm, all_color_terms.size()> heaviest_first(const ColorAccount& account) {
    std::array terms = all_color_terms;
    std::stable_sort(terms.begin(), terms.end(), [&](ColorTerm a, ColorTerm b) {
        return weight_of(account, a) > weight_of(account, b);
    });
    return terms;
}

Json color_json(const glm::dvec3& color) {
    return {color.x, color.y, color.z};
}

Json ends_json(const Intervals& color) {
    Json channels = Json::array();
    for (const Interval& channel : color) channels.push_back({channel.low, channel.high});
    return channels;
}

} // namespace

std::string_view name_of(ColorVerdict verdict) {
    switch (verdict) {
    case ColorVerdict::as_shown:
        return "as_shown";
    case ColorVerdict::within:
        return "within";
    case ColorVerdict::beyond:
        return "beyond";
    case ColorVerdict::unpredicted:
        return "unpredicted";
    case ColorVerdict::moved:
        return "moved";
    case ColorVerdict::unexplained:
        break;
    }
    return "unexplained";
}

namespace {

/// A line for each light that is added.
std::string added_lines(const ColorAccount& account) {
    std::string lines;
    for (const AddedAtPixel& light : account.lights_before)
        lines += fmt::format("    added     light of {}: {}, claimed {}\n", printable(light.name),
                             name_of(light.truth), name_of(light.claim));
    return lines;
}

} // namespace

std::string to_text(const ColorAccount& account, const std::string& technique) {
    if (account.verdict == ColorVerdict::as_shown)
        return fmt::format("  colour of {}: {}\n", technique, meaning_of(account.verdict)) +
               added_lines(account);
    const std::string mean = account.rays.x > 0 ? fmt::format(", the mean of {} x {} rays",
                                                              account.rays.x, account.rays.y)
                                                : "";
    std::string text =
        fmt::format("  colour of {}: {}\n    true      {}{}\n    claimed   {}\n    bound     {}\n"
                    "    predicted  {}\n    moved by ",
                    technique, meaning_of(account.verdict), words_of(account.showable), mean,
                    words_of(account.claim), words_of(account.bound), words_of(account.predicted));
    std::string_view separator;
    for (const ColorTerm term : heaviest_first(account)) {
        text += fmt::format("{} {} {:.2f}/255", separator, name_of(term), weight_of(account, term));
        separator = ",";
    }
    return text + "\n" + added_lines(account);
}

nlohmann::ordered_json to_json(const ColorAccount& account) {
    Json json{{"verdict", name_of(account.verdict)},
              {"true", color_json(account.showable)},
              {"claimed", color_json(account.claim)}};
    if (account.rays.x > 0) json["rays"] = {account.rays.x, account.rays.y};
    for (const AddedAtPixel& light : account.lights_before)
        json["added"].push_back({{"light", light.name},
                                 {"truth", name_of(light.truth)},
                                 {"claim", name_of(light.claim)}});
    if (account.verdict == ColorVerdict::as_shown) return json;
    json["bound"] = ends_json(account.bound);
    json["predicted"] = ends_json(account.predicted);
    for (const ColorTerm term : heaviest_first(account))
        json["moved_by"][std::string(name_of(term))] = weight_of(account, term);
    return json;
}

} // namespace shadowproof
