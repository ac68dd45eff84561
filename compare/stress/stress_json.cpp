#include "compare/stress/stress_json.h"

namespace shadowproof {

namespace {

using Json = ResultsJson;

/// One frame: its time is its own median.
Json time_json(double milliseconds) {
    return {{"median", milliseconds}, {"low", milliseconds}, {"high", milliseconds}};
}

/// What all entries of a point share.
Json head_json(const StressScene& scene, const StressAlong& along, const StressPoint& point,
               const std::string& technique) {
    Json json{{"scene", scene.name},
              {"technique", technique},
              {"parameter", along.parameter},
              {"value", point.value}};
    if (point.own) json["own"] = true;
    if (point.searched) json["searched"] = true;
    return json;
}

Json truth_json(const StressScene& scene, const StressAlong& along, const StressPoint& point) {
    Json json = head_json(scene, along, point, truth_point);
    if (!point.refused.empty()) {
        json["refused"] = point.refused;
        if (point.loss != Loss::none) json["loss"] = name_of(point.loss);
        return json;
    }
    json["ms"] = time_json(point.trace_milliseconds);
    json["causes"] = Json::object();
    json["differing"] = 0;
    json["pixels"] = scene.width * scene.height;
    json["triangles"] = point.triangles;
    json["rays"] = point.rays;
    json["exact_decisions"] = point.exact_decisions;
    json["degenerate"] = point.degenerate;
    json["witness"] = {{"asked", point.witness.asked},
                       {"undecided", point.witness.undecided},
                       {"disagreements", point.witness.disagreements}};
    json["relations"] = {{"tried", point.relations.tried},
                         {"left_out", point.relations.left_out},
                         {"compared", point.relations.compared},
                         {"ties", point.relations.ties},
                         {"changed", point.relations.changed}};
    return json;
}

Json cell_json(const StressScene& scene, const StressAlong& along, const StressPoint& point,
               const StressCell& cell) {
    Json json = head_json(scene, along, point, cell.technique);
    if (!cell.refused.empty()) {
        json["refused"] = cell.refused;
        if (cell.loss != Loss::none) json["loss"] = name_of(cell.loss);
        if (!cell.command.empty()) json["command"] = cell.command;
        return json;
    }
    json["family"] = cell.family;
    json["ms"] = time_json(cell.milliseconds);
    json["judging_ms"] = cell.judging;
    json["verdict"] = name_of(cell.verdict);
    json["pixels"] = cell.error.pixels;
    json["causes"] = Json::object();
    for (const auto& [cause, pixels] : cell.error.causes) json["causes"][cause] = pixels;
    json["differing"] = cell.error.differing;
    json["falsely_lit"] = cell.error.falsely_lit;
    json["falsely_shadowed"] = cell.error.falsely_shadowed;
    json["command"] = cell.command;
    if (!cell.pictures.empty()) json["pictures"] = cell.pictures;
    return json;
}

Json breaking_json(const StressScene& scene, const StressAlong& along, const Breaking& breaking) {
    Json json{{"scene", scene.name},          {"technique", breaking.technique},
              {"parameter", along.parameter}, {"side", breaking.up ? "up" : "down"},
              {"derived", nullptr},           {"measured", nullptr},
              {"holds", breaking.holds}};
    if (breaking.derived) json["derived"] = *breaking.derived;
    if (breaking.fails) {
        json["measured"] = *breaking.fails;
        json["cause"] = breaking.cause;
    }
    return json;
}

Json scene_json(const StressScene& scene) {
    Json json{{"name", scene.name}, {"file", scene.file}};
    if (!scene.error.empty()) {
        json["error"] = scene.error;
        return json;
    }
    json["digest"] = scene.digest;
    json["light"] = scene.light;
    json["width"] = scene.width;
    json["height"] = scene.height;
    json["triangles"] = scene.triangles;
    json["parameters"] = Json::array();
    for (const StressAlong& along : scene.parameters)
        json["parameters"].push_back({{"name", along.parameter},
                                      {"words", along.words},
                                      {"wrong_before", along.wrong_before}});
    json["left_out"] = scene.left_out;
    return json;
}

} // namespace

ResultsJson stress_json(const StressRun& run) {
    Json json{{"schema", stress_schema},
              {"version", run.version},
              {"gl",
               {{"version", run.gl.version},
                {"renderer", run.gl.renderer},
                {"subpixel_bits", run.gl.subpixel_bits},
                {"depth_bits", run.gl.depth_bits},
                {"stencil_bits", run.gl.stencil_bits}}},
              {"embree", run.embree},
              {"arguments", run.arguments},
              {"scenes", Json::array()},
              {"points", Json::array()},
              {"breaking", Json::array()}};
    for (const StressScene& scene : run.scenes) {
        json["scenes"].push_back(scene_json(scene));
        for (const StressAlong& along : scene.parameters) {
            for (const StressPoint& point : along.points) {
                json["points"].push_back(truth_json(scene, along, point));
                for (const StressCell& cell : point.cells)
                    json["points"].push_back(cell_json(scene, along, point, cell));
            }
            for (const Breaking& breaking : along.breaking)
                json["breaking"].push_back(breaking_json(scene, along, breaking));
        }
    }
    return json;
}

} // namespace shadowproof
