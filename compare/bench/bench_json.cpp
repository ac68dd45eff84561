#include "compare/bench/bench_json.h"

#include "compare/bench/interval.h"
#include "scenes/cause.h"

namespace shadowproof {

namespace {

using Json = ResultsJson;

Json settings_json(const BenchSettings& settings) {
    Json json = Json::object();
    for (const auto& [name, value] : settings) json[name] = value;
    return json;
}

Json time_json(const std::vector<double>& samples) {
    const TimeInterval interval = median_interval(samples);
    return {{"median", interval.median},      {"low", interval.low},
            {"high", interval.high},          {"interval", interval.is_known},
            {"settled", is_settled(samples)}, {"samples", samples}};
}

Json stages_json(const std::vector<BenchStage>& stages) {
    Json json = Json::object();
    for (const BenchStage& stage : stages)
        json[stage.name] = {{"median", median_interval(stage.samples).median},
                            {"samples", stage.samples}};
    return json;
}

Json point_json(const BenchPoint& point) {
    Json json{{"scene", point.scene},
              {"technique", point.technique},
              {"family", point.family},
              {"settings", settings_json(point.settings)}};
    if (!point.own.empty()) json["own"] = settings_json(point.own);
    json["ms"] = time_json(point.samples);
    if (!point.stages.empty()) json["stages"] = stages_json(point.stages);
    json["pixels"] = point.error.pixels;
    json["causes"] = Json::object();
    for (const auto& [cause, pixels] : point.error.causes) json["causes"][cause] = pixels;
    json["differing"] = point.error.differing;
    json["falsely_lit"] = point.error.falsely_lit;
    json["falsely_shadowed"] = point.error.falsely_shadowed;
    if (const std::optional<BenchColor>& color = point.error.color)
        json["color"] = {
            {"rmse", color->rmse}, {"largest", color->largest}, {"p999", color->percentile999}};
    json["command"] = point.command;
    if (!point.pictures.empty()) json["pictures"] = point.pictures;
    return json;
}

Json exponent_json(const Exponent& exponent) {
    return {{"value", exponent.value}, {"low", exponent.low}, {"high", exponent.high}};
}

Json growth_json(const Growth& growth) {
    Json json{{"axis", growth.axis}, {"scene", growth.scene}, {"technique", growth.technique}};
    if (!growth.family.empty()) json["family"] = growth.family;
    json["command"] = growth.command;
    json["points"] = Json::array();
    for (const GrowthPoint& point : growth.points)
        json["points"].push_back({{"size", point.size}, {"ms", time_json(point.samples)}});
    if (const auto exponent = exponent_of(growth.points))
        json["exponent"] = exponent_json(*exponent);
    if (const auto broken = break_of(growth.points))
        json["break"] = {{"size", broken->size},
                         {"below", exponent_json(broken->below)},
                         {"above", exponent_json(broken->above)}};
    return json;
}

BenchSettings settings_of(const Json& json) {
    BenchSettings settings;
    for (const auto& [name, value] : json.items())
        settings.emplace_back(name, value.get<std::string>());
    return settings;
}

BenchPoint point_of(const Json& json) {
    BenchPoint point{.scene = json.at("scene"),
                     .technique = json.at("technique"),
                     .family = json.value("family", ""),
                     .settings = settings_of(json.at("settings")),
                     .own = settings_of(json.value("own", Json::object())),
                     .samples = json.at("ms").at("samples").get<std::vector<double>>(),
                     .error = {.pixels = json.at("pixels"),
                               .differing = json.at("differing"),
                               .falsely_lit = json.at("falsely_lit"),
                               .falsely_shadowed = json.at("falsely_shadowed")},
                     .command = json.at("command"),
                     .pictures = json.value("pictures", "")};
    if (json.contains("stages"))
        for (const auto& [name, stage] : json.at("stages").items())
            point.stages.push_back({name, stage.at("samples").get<std::vector<double>>()});
    for (const auto& [cause, pixels] : json.at("causes").items())
        point.error.causes.emplace_back(cause, pixels.get<std::uint64_t>());
    if (json.contains("color"))
        point.error.color = BenchColor{.rmse = json.at("color").at("rmse"),
                                       .largest = json.at("color").at("largest"),
                                       .percentile999 = json.at("color").at("p999")};
    return point;
}

Growth growth_of(const Json& json) {
    Growth growth{.axis = json.at("axis"),
                  .scene = json.at("scene"),
                  .technique = json.at("technique"),
                  .family = json.value("family", ""),
                  .command = json.at("command"),
                  .points = {}};
    for (const Json& point : json.at("points"))
        growth.points.push_back(
            {point.at("size"), point.at("ms").at("samples").get<std::vector<double>>()});
    return growth;
}

} // namespace

Json bench_json(const BenchRun& run) {
    Json json{{"schema", bench_schema},
              {"version", run.version},
              {"gl",
               {{"version", run.gl.version},
                {"renderer", run.gl.renderer},
                {"subpixel_bits", run.gl.subpixel_bits},
                {"depth_bits", run.gl.depth_bits},
                {"stencil_bits", run.gl.stencil_bits}}},
              {"embree", run.embree},
              {"machine",
               {{"processor", run.machine.processor},
                {"cores", run.machine.cores},
                {"system", run.machine.system}}},
              {"arguments", run.arguments},
              {"finished", run.finished},
              {"scenes", Json::array()},
              {"points", Json::array()},
              {"left_out", Json::array()},
              {"scaling", Json::array()}};
    for (const BenchScene& scene : run.scenes)
        json["scenes"].push_back({{"name", scene.name},
                                  {"file", scene.file},
                                  {"digest", scene.digest},
                                  {"light", scene.light},
                                  {"width", scene.width},
                                  {"height", scene.height},
                                  {"triangles", scene.triangles},
                                  {"finished", scene.finished}});
    for (const BenchPoint& point : run.points) json["points"].push_back(point_json(point));
    for (const BenchLeftOut& out : run.left_out) {
        Json left{{"scene", out.scene}};
        if (!out.technique.empty()) left["technique"] = out.technique;
        if (!out.axis.empty()) left["axis"] = out.axis;
        if (!out.settings.empty()) left["settings"] = settings_json(out.settings);
        left["why"] = out.why;
        if (out.loss != Loss::none) left["loss"] = name_of(out.loss);
        json["left_out"].push_back(left);
    }
    for (const Growth& growth : run.growth) json["scaling"].push_back(growth_json(growth));
    return json;
}

BenchRun bench_of_json(const Json& json) {
    const Json& gl = json.at("gl");
    const Json& machine = json.at("machine");
    BenchRun run{.version = json.at("version"),
                 .gl = {gl.at("version"), gl.at("renderer"), gl.at("subpixel_bits"),
                        gl.at("depth_bits"), gl.at("stencil_bits")},
                 .embree = json.at("embree"),
                 .machine = {machine.at("processor"), machine.at("cores"), machine.at("system")},
                 .arguments = json.at("arguments").get<std::vector<std::string>>(),
                 .finished = json.at("finished")};
    for (const Json& scene : json.at("scenes"))
        run.scenes.push_back({.name = scene.at("name"),
                              .file = scene.at("file"),
                              .digest = scene.at("digest"),
                              .light = scene.at("light"),
                              .width = scene.at("width"),
                              .height = scene.at("height"),
                              .triangles = scene.at("triangles"),
                              .finished = scene.at("finished")});
    for (const Json& point : json.at("points")) run.points.push_back(point_of(point));
    for (const Json& out : json.at("left_out"))
        run.left_out.push_back({out.at("scene"), out.value("technique", ""),
                                settings_of(out.value("settings", Json::object())), out.at("why"),
                                loss_of(out.value("loss", "")), out.value("axis", "")});
    for (const Json& growth : json.at("scaling")) run.growth.push_back(growth_of(growth));
    return run;
}

} // namespace shadowproof
