#include "compare/bench/bench_file.h"

#include "compare/bench/bench_json.h"
#include "compare/json/json_rules.h"
#include "scenes/roundoff.h"

#include <cmath>
#include <system_error>
#include <tuple>

namespace shadowproof {

using namespace json_rules;

namespace {

using Json = ResultsJson;

constexpr const char* measure_again = "measure again with shadowproof bench";
constexpr JsonRemedies of_bench{"name a file that bench --json wrote, or the folder of its plot",
                                "give the whole file that bench --json wrote"};

void schema(const JsonPlace& place) {
    if (place.value != bench_schema)
        refuse(place, fmt::format("must be \"{}\", but is {}", bench_schema, shown(place.value)),
               "give what bench --json wrote, or use the shadowproof that wrote it");
}

void finite(const JsonPlace& place) {
    require(place.value.is_number() && std::isfinite(place.value.get<double>()), place,
            "a finite number");
}
void positive(const JsonPlace& place) {
    require(place.value.is_number() && place.value.get<double>() > 0, place, "a number above 0");
}

void settings(const JsonPlace& place) {
    require(place.value.is_object(), place, "an object");
    for (const auto& [name, value] : place.value.items()) text(place.at(name));
}

void time(const JsonPlace& place) {
    object(place, {{"median", milliseconds},
                   {"low", milliseconds},
                   {"high", milliseconds},
                   {"interval", boolean, Need::optional},
                   {"settled", boolean},
                   {"samples", some_of<milliseconds>}});
    const auto samples = place.value.at("samples").get<std::vector<double>>();
    const TimeInterval interval = median_interval(samples);
    if (place.value.at("median") != interval.median || place.value.at("low") != interval.low ||
        place.value.at("high") != interval.high || place.value.at("settled") != is_settled(samples))
        refuse(place, "is not the interval of its samples");
    if (place.value.value("interval", interval.is_known) != interval.is_known)
        refuse(place.at("interval"), "is not so by the number of its samples");
}

/// `count`: of the point's own samples.
void stage(const JsonPlace& place, std::size_t count) {
    object(place, {{"median", milliseconds}, {"samples", some_of<milliseconds>}});
    const auto samples = place.value.at("samples").get<std::vector<double>>();
    if (samples.size() != count) refuse(place.at("samples"), "are not as many as those of \"ms\"");
    if (place.value.at("median") != median_interval(samples).median)
        refuse(place.at("median"), "is not that of the samples");
}

/// A cell of the report beside the plot. The plot links to it, and it may lead nowhere else.
void cell_address(const JsonPlace& place) {
    constexpr std::string_view page = "pictures/index.html#";
    constexpr std::string_view plain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
    const auto leads_there = [&](const std::string& text) {
        const std::size_t slash = text.find('/', page.size());
        return text.starts_with(page) && slash != std::string::npos && slash > page.size() &&
               slash + 1 < text.size() && text.find_first_not_of(plain, page.size()) == slash &&
               text.find_first_not_of(plain, slash + 1) == std::string::npos;
    };
    require(place.value.is_string() && leads_there(place.value.get_ref<const std::string&>()),
            place, "the address of a cell, as \"pictures/index.html#near_plane/zpass\"");
}

void any_object(const JsonPlace& place) {
    require(place.value.is_object(), place, "an object");
}

void color(const JsonPlace& place) {
    object(place, {{"rmse", amount}, {"largest", amount}, {"p999", amount}});
}

void point(const JsonPlace& place) {
    object(place, {{"scene", some_text},
                   {"technique", some_text},
                   {"family", text, Need::optional},
                   {"settings", settings},
                   {"own", settings, Need::optional},
                   {"ms", time},
                   {"stages", any_object, Need::optional},
                   {"pixels", size},
                   {"causes", causes},
                   {"differing", count},
                   {"falsely_lit", amount},
                   {"falsely_shadowed", amount},
                   {"color", color, Need::optional},
                   {"command", text},
                   {"pictures", cell_address, Need::optional}});
    if (place.value.contains("stages"))
        for (const auto& [name, each] : place.value.at("stages").items())
            stage(place.at("stages").at(name), place.value.at("ms").at("samples").size());
    std::uint64_t sum = 0;
    for (const auto& [name, pixels] : place.value.at("causes").items())
        sum += pixels.get<std::uint64_t>();
    const Json& differing = place.value.at("differing");
    if (differing != sum) refuse(place.at("causes"), "do not add up to \"differing\"");
    if (differing > place.value.at("pixels"))
        refuse(place.at("differing"), "is more than the picture has");
    // Shares of at most one are added up, pixel by pixel: each share and each sum rounds by at most
    // 2^-53 of what all come to.
    const auto most = static_cast<double>(sum);
    if (place.value.at("falsely_lit").get<double>() +
            place.value.at("falsely_shadowed").get<double>() >
        most + 2 * most * double_roundoff * most)
        refuse(place.at("falsely_lit"), "is more than what differs, with \"falsely_shadowed\"");
}

void scene(const JsonPlace& place) {
    object(place, {{"name", some_text},
                   {"file", text},
                   {"digest", text},
                   {"light", text},
                   {"width", size},
                   {"height", size},
                   {"triangles", count},
                   {"finished", boolean}});
}

void left_out(const JsonPlace& place) {
    object(place, {{"scene", text},
                   {"technique", text, Need::optional},
                   {"axis", some_text, Need::optional},
                   {"settings", settings, Need::optional},
                   {"why", text}});
}

void machine(const JsonPlace& place) {
    object(place, {{"processor", text}, {"cores", count}, {"system", text}});
}

void exponent(const JsonPlace& place) {
    object(place, {{"value", finite}, {"low", finite}, {"high", finite}});
}

void broken(const JsonPlace& place) {
    object(place, {{"size", positive}, {"below", exponent}, {"above", exponent}});
}

void growth_point(const JsonPlace& place) {
    object(place, {{"size", positive}, {"ms", time}});
}

void growth(const JsonPlace& place) {
    object(place, {{"axis", some_text},
                   {"scene", text},
                   {"technique", some_text},
                   {"family", some_text, Need::optional},
                   {"command", text},
                   {"points", some_of<growth_point>},
                   {"exponent", exponent, Need::optional},
                   {"break", broken, Need::optional}});
}

bool are_one(const Json& a, const Json& b) {
    const auto key = [](const Json& point) {
        return std::tie(point.at("scene"), point.at("technique"), point.at("settings"));
    };
    return key(a) == key(b);
}

} // namespace

void check_bench(const Json& bench, const std::string& file) {
    const JsonPlace whole{file, "", bench, measure_again};
    object(whole, {{"schema", schema}}); // before the rules of that schema
    object(whole, {{"version", some_text},
                   {"gl", gl},
                   {"embree", text},
                   {"machine", machine},
                   {"arguments", list_of<text>},
                   {"finished", boolean},
                   {"scenes", list_of<scene>},
                   {"points", list_of<point>},
                   {"left_out", list_of<left_out>},
                   {"scaling", list_of<growth>}});
    const JsonPlace points = whole.at("points");
    for (std::size_t i = 0; i < points.value.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (are_one(points.value.at(i), points.value.at(k)))
                refuse(points.at(i), fmt::format("is the same point as /points/{}", k));
}

BenchRun read_bench(const std::filesystem::path& path, MemoryAccount* memory) {
    std::error_code ignored;
    const std::filesystem::path file =
        std::filesystem::is_directory(path, ignored) ? path / "results.json" : path;
    const Json json = parse_json(json_text(file, of_bench, memory), file.string(), of_bench);
    check_bench(json, file.string());
    return bench_of_json(json);
}

} // namespace shadowproof
