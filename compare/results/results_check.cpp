#include "compare/results/results_check.h"

#include "compare/families.h"
#include "compare/json/json_rules.h"
#include "compare/report/report.h"
#include "compare/results/results_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace shadowproof {

using namespace json_rules;

namespace {

using Json = ResultsJson;

void always_true(const JsonPlace& place) {
    require(place.value == true, place, "true, as what could not run fails");
}
/// OpenGL's pictures have sides of 32 bits, so the product of two does not overflow.
void side(const JsonPlace& place) {
    require(is_count(place.value, 1) && place.value.get<std::uint64_t>() <= 0x7fffffff, place,
            "a whole number from 1 to 2147483647");
}
void folder(const JsonPlace& place) {
    require(place.value.is_string() && is_plain_name(place.value.get_ref<const std::string&>()),
            place, "a plain folder name of letters, digits, '-' and '_'");
}
void light_kind(const JsonPlace& place) {
    one_of(place, {"point", "spot", "directional"});
}
void technique(const JsonPlace& place) {
    require(place.value.is_string() && is_technique_name(place.value.get_ref<const std::string&>()),
            place, "a technique's name, or several joined by '+'");
}
void family(const JsonPlace& place) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
    const auto holds = [&](const std::string& name) {
        return !name.empty() && std::all_of(name.begin(), name.end(), is_letter);
    };
    require(place.value.is_string() && holds(place.value.get_ref<const std::string&>()), place,
            "a family's name of small letters and '_'");
}
void digest(const JsonPlace& place) {
    const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    const auto holds = [&](const std::string& d) {
        return d.size() == 16 && std::all_of(d.begin(), d.end(), is_digit);
    };
    require(place.value.is_string() && holds(place.value.get_ref<const std::string&>()), place,
            "16 digits of 0-9 and a-f");
}

void gate(const JsonPlace& place) {
    one_of(place, {"defects", "differences"});
}
void verdict(const JsonPlace& place) {
    one_of(place, {"agrees", "fails_as_predicted", "defect", "unexplained"});
}
void timed_out(const JsonPlace& place) {
    one_of(place, {"timed_out"});
}

void schema(const JsonPlace& place) {
    if (place.value != results_schema)
        refuse(place, fmt::format("must be \"{}\", but is {}", results_schema, shown(place.value)),
               "give a results.json of shadowproof, or use the shadowproof that wrote it");
}
void format(const JsonPlace& place) {
    if (place.value != results_format)
        refuse(place, fmt::format("must be {}, but is {}", results_format, shown(place.value)),
               "write the results again with shadowproof verify, or use the shadowproof that wrote "
               "them");
}

/// Results with an error have no figures: with both they would be ambiguous.
void nothing_beside_error(const JsonPlace& place, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (place.value.contains(name))
            refuse(place, fmt::format("has both \"error\" and \"{}\"", name));
}

void reference(const JsonPlace& place) {
    object(place, {{"ms", milliseconds},
                   {"build_ms", milliseconds},
                   {"rays", count},
                   {"exact_decisions", count},
                   {"lit", count},
                   {"shadowed", count},
                   {"background", count},
                   {"degenerate", count}});
}

void first(const JsonPlace& place) {
    object(place, {{"x", count}, {"y", count}, {"cause", cause}});
}

void cause_or_none(const JsonPlace& place) {
    if (!place.value.is_null()) cause(place);
}

void change(const JsonPlace& place) {
    object(place, {{"x", count},
                   {"y", count},
                   {"cause", cause_or_none, Need::optional},
                   {"was", cause_or_none, Need::optional}});
}

void since(const JsonPlace& place) {
    object(
        place,
        {{"new", count}, {"gone", count}, {"changed", count}, {"first", change, Need::optional}});
}

void baseline(const JsonPlace& place) {
    object(place, {{"file", text},
                   {"passed", boolean, Need::optional},
                   {"notes", list_of<text>, Need::optional}});
}

void reasons(const JsonPlace& place) {
    require(place.value.is_object(), place, "an object");
    for (const auto& [name, reason] : place.value.items()) some_text(place.at(name));
}

void accepted(const JsonPlace& place) {
    object(place, {{"at", text}, {"reasons", reasons}});
}

void accepted_cause(const JsonPlace& place) {
    object(place, {{"cause", cause}, {"reason", some_text}});
}

void truth_images(const JsonPlace& place) {
    object(place, {{"truth", text}});
}
void cell_images(const JsonPlace& place) {
    object(place, {{"claim", text}, {"difference", text}, {"cause", text}});
}
void place_in_picture(const JsonPlace& place) {
    object(place, {{"x", count}, {"y", count}});
}

void bound_width(const JsonPlace& place) {
    object(place, {{"median", number}, {"p999", number}, {"widest", number}});
}

/// By the names of ColorTerm.
void beyond_by(const JsonPlace& place) {
    require(place.value.is_object(), place, "an object");
    for (const auto& [name, pixels] : place.value.items()) count(place.at(name));
}

void light_before(const JsonPlace& place) {
    object(place, {{"name", text}, {"differing", count}});
}

void error_bin(const JsonPlace& place) {
    object(place, {{"from", number}, {"to", number}, {"pixels", count}, {"rmse", number}});
}

void pixel_means(const JsonPlace& place) {
    object(place, {{"most_rays", count},
                   {"noise", number},
                   {"rmse", number},
                   {"alike", count},
                   {"alike_rmse", number},
                   {"by_texels", list_of<error_bin>},
                   {"by_angle", list_of<error_bin>}});
}

void color(const JsonPlace& place) {
    object(place, {{"judged", count},
                   {"largest", number},
                   {"largest_at", place_in_picture, Need::optional},
                   {"rmse", number},
                   {"picture_rmse", number, Need::optional},
                   {"p999", number},
                   {"beyond", count},
                   {"beyond_by", beyond_by, Need::optional},
                   {"unpredicted", count},
                   {"moved", count, Need::optional},
                   {"interpolated", count, Need::optional},
                   {"bound_width", bound_width, Need::optional},
                   {"first_unpredicted", place_in_picture, Need::optional},
                   {"normalise", text},
                   {"cube_size", size, Need::optional},
                   {"newton_steps", count, Need::optional},
                   {"bumps", text},
                   {"vectors", text, Need::optional}, // absent in results of older versions
                   {"tangents", text, Need::optional},
                   {"filter", text, Need::optional},
                   {"anisotropy", size, Need::optional},
                   {"pixel_means", pixel_means, Need::optional},
                   {"lights_before", list_of<light_before>, Need::optional}});
}

void failed_cell(const JsonPlace& place) {
    object(place, {{"name", text},
                   {"summary", text},
                   {"command", text},
                   {"fails", always_true},
                   {"verdict", timed_out, Need::optional},
                   {"error", some_text}});
    nothing_beside_error(place, {"images", "causes", "cause_map"});
}

void cell(const JsonPlace& place) {
    if (place.value.is_object() && could_not_run(place.value)) return failed_cell(place);
    object(place, {{"name", technique},
                   {"family", family},
                   {"summary", text},
                   {"command", text},
                   {"fails", boolean},
                   {"gate", gate, Need::optional},
                   {"allow", list_of<text>, Need::optional},
                   {"ms", milliseconds},
                   {"spent_ms", milliseconds, Need::optional},
                   {"left_out", list_of<text>, Need::optional},
                   {"verdict", verdict},
                   {"pixels", size},
                   {"differing", count},
                   {"causes", causes},
                   {"several", count, Need::optional},
                   {"too_near", count, Need::optional},
                   {"partly_lit", count, Need::optional},
                   {"wrongness", amount, Need::optional},
                   {"first", first, Need::optional},
                   {"color", color, Need::optional},
                   {"images", cell_images},
                   {"cause_map", some_text},
                   {"since", since, Need::optional},
                   {"accepted", list_of<accepted_cause>, Need::optional}});
    require(place.value.contains("gate") == place.value.contains("allow"), place,
            "an object with both gate and allow, or neither");
    // Of a family that a newer version knows, its own members are accepted as they are.
    const Family* const own = find_family(place.value.at("family").get<std::string>());
    if (own != nullptr && own->check_results != nullptr) own->check_results(place);
}

void scene(const JsonPlace& place) {
    if (place.value.is_object() && could_not_run(place.value)) {
        object(place, {{"name", text},
                       {"file", text},
                       {"width", count, Need::optional},
                       {"height", count, Need::optional},
                       {"error", some_text}});
        nothing_beside_error(place, {"techniques", "images", "no_longer_provoked"});
        return;
    }
    object(place,
           {{"name", text},
            {"file", text},
            {"width", side},
            {"height", side},
            {"folder", folder},
            {"digest", digest},
            {"triangles", count},
            {"light", text},
            {"light_kind", light_kind, Need::optional}, // absent in results of older versions
            {"provokes", list_of<cause>},
            {"no_longer_provoked", list_of<cause>},
            {"left_out", list_of<text>},
            {"notes", list_of<text>},
            {"reference", reference},
            {"spent_ms", milliseconds, Need::optional},
            {"images", truth_images},
            {"techniques", some_of<cell>}});
    check_scene_figures(place);
    const JsonPlace cells = place.at("techniques");
    std::set<std::string> names;
    for (std::size_t i = 0; i < cells.value.size(); ++i) {
        check_cell_figures(cells.at(i), place.value);
        if (!names.insert(cells.value.at(i).at("name").get<std::string>()).second)
            refuse(cells.at(i).at("name"), "stands there twice");
    }
}

void shard_count(const JsonPlace& place) {
    require(is_count(place.value, 1) && place.value.get<std::uint64_t>() <= 1'000'000, place,
            "a whole number from 1 to 1000000");
}

void outlined_cell(const JsonPlace& place) {
    object(place, {{"name", text}, {"error", boolean, Need::optional}});
}

void outlined_scene(const JsonPlace& place) {
    object(place, {{"name", text},
                   {"error", boolean, Need::optional},
                   {"digest", digest, Need::optional},
                   {"techniques", list_of<outlined_cell>, Need::optional}});
    if (!could_not_run(place.value))
        for (const char* member : {"digest", "techniques"})
            if (!place.value.contains(member)) refuse(place, fmt::format("lacks \"{}\"", member));
}

void outlined_baseline(const JsonPlace& place) {
    object(place,
           {{"version", text}, {"embree", text}, {"gl", gl}, {"scenes", list_of<outlined_scene>}});
}

void shard(const JsonPlace& place) {
    object(place, {{"number", shard_count},
                   {"of", shard_count},
                   {"run", digest},
                   {"baseline", outlined_baseline, Need::optional}});
    require(place.value.at("number") <= place.value.at("of"), place.at("number"),
            "no more than \"of\"");
}

void scenes_apart(const JsonPlace& place) {
    require(place.value.is_array(), place, "an array");
}

} // namespace

bool is_plain_name(std::string_view name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_';
    });
}

bool is_technique_name(std::string_view name) {
    while (true) {
        const std::size_t end = std::min(name.find('+'), name.size());
        if (!is_plain_name(name.substr(0, end))) return false;
        if (end == name.size()) return true;
        name.remove_prefix(end + 1);
    }
}

bool could_not_run(const Json& scene_or_cell) {
    return scene_or_cell.contains("error");
}

bool has_same_gate(const Json& a, const Json& b) {
    const auto allowed = [](const Json& each) { return each.value("allow", Json::array()); };
    return a.at("gate") == b.at("gate") && allowed(a) == allowed(b);
}

bool scene_fails(const Json& scene) {
    if (could_not_run(scene) || !scene.at("no_longer_provoked").empty()) return true;
    const Json& cells = scene.at("techniques");
    return std::any_of(cells.begin(), cells.end(),
                       [](const Json& cell) { return cell.at("fails") == true; });
}

void check_schema(const Json& results, const std::string& file) {
    const JsonPlace whole{file, "", results};
    // The schema's name is checked before its rules.
    object(whole, {{"schema", schema}});
    object(whole, {{"format", format}});
}

void ResultsCheck::next(const Json& scene_given) {
    const JsonPlace place{file_, fmt::format("/scenes/{}", scenes_++), scene_given};
    scene(place);
    any_fails_ = any_fails_ || scene_fails(scene_given);
    if (could_not_run(scene_given)) return;
    // A cell's data are found by the folder of its scene.
    if (!folders_.insert(scene_given.at("folder").get<std::string>()).second)
        refuse(place.at("folder"), "is the folder of another scene too");
}

void ResultsCheck::end(const Json& results) const {
    check_schema(results, file_);
    const JsonPlace whole{file_, "", results};
    object(whole, {{"version", some_text},
                   {"gl", gl},
                   {"embree", text},
                   {"arguments", list_of<text>},
                   {"gate", gate},
                   {"allow", list_of<text>, Need::optional},
                   {"baseline", baseline, Need::optional},
                   {"accepted", accepted, Need::optional},
                   {"shard", shard, Need::optional},
                   {"passed", boolean},
                   {"ms", milliseconds},
                   {"report_ms", milliseconds},
                   {"scenes", scenes_apart}});
    // One of many shards may have nothing to try.
    require(scenes_ > 0 || results.contains("shard"), whole.at("scenes"),
            "an array that is not empty");
    if (results.at("passed") == true && any_fails_)
        refuse(whole.at("passed"), "is true, but a scene or a cell fails");
}

void check_results(const Json& results, const std::string& file) {
    check_schema(results, file);
    ResultsCheck check(file);
    if (results.contains("scenes") && results.at("scenes").is_array())
        for (const Json& scene : results.at("scenes")) check.next(scene);
    check.end(results);
}

} // namespace shadowproof
