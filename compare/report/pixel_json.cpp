#include "compare/report/pixel_json.h"

#include "compare/judge/crossing_json.h"
#include "compare/report/color_words.h"
#include "compare/report/light_json.h"

#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

Json technique_json(const Scene& scene, const TechniqueAtPixel& technique) {
    if (!technique.error.empty()) return {{"name", technique.name}, {"error", technique.error}};
    Json json{{"name", technique.name}, {"family", technique.family}};
    const std::string& members = technique.account.members;
    if (!members.empty()) json.update(Json::parse(members));
    json["claim"] = name_of(technique.claim);
    if (technique.claim == Visibility::partly_lit) json["share"] = technique.share;
    if (technique.shows_surface) json["shown"] = triangle_json(scene, technique.shown);
    json["cause"] =
        technique.cause == no_difference ? Json(nullptr) : Json(all_causes[technique.cause].name);
    json["also"] = Json::array();
    for (const Cause cause : technique.also) json["also"].push_back(name_of(cause));
    if (technique.too_near) json["too_near"] = true;
    if (technique.color) json["color"] = to_json(*technique.color);
    return json;
}

/// How many volumes points of the ray are in.
Json inside_json(const PixelRecord& record) {
    const RayCounts& counts = record.ledger.counts;
    const bool seen = record.seen != no_triangle;
    return {{"eye", counts.at_eye},
            {"near", counts.at_near},
            {"surface", seen ? Json(counts.at_surface) : Json(nullptr)},
            {"far", counts.at_far},
            {"infinity", counts.at_infinity},
            {"let_through", record.let_through}};
}

} // namespace

nlohmann::ordered_json to_json(const Scene& scene, const PixelRecord& record,
                               const std::vector<TechniqueAtPixel>& techniques) {
    const Camera& camera = scene.camera;
    const bool seen = record.seen != no_triangle;
    Json json{{"schema", "shadowproof/pixel/1"},
              {"scene", scene.name},
              {"x", record.x},
              {"y", record.y},
              {"width", camera.width},
              {"height", camera.height},
              {"eye", vector_json(record.start)},
              {"direction", vector_json(record.direction)},
              {"orthographic", camera.is_orthographic()},
              {"near", camera.near},
              {"far", record.far},
              {"light", light_json(chosen_light(scene))},
              {"truth", name_of(record.visibility)},
              {"exactness", name_of(record.exactness)},
              {"seen", triangle_json(scene, record.seen)},
              {"occluder", triangle_json(scene, record.occluder)},
              {"margin",
               {{"depth", optional_json(record.depth_margin)},
                {"pixels", optional_json(record.pixel_margin)}}},
              {"inside", inside_json(record)},
              {"crossings", Json::array()},
              {"adds_up", record.ledger.adds_up},
              {"notes", scene.notes},
              {"techniques", Json::array()}};
    if (seen) {
        json["seen"]["depth"] = record.depth;
        json["seen"]["point"] = vector_json(record.start + record.depth * record.direction);
        json["seen"]["corners"] = corners_json(scene, record.seen);
        json["seen"]["faces_light"] = record.faces_light;
        if (chosen_light(scene).kind == Light::Kind::spot) json["seen"]["in_cone"] = record.in_cone;
    }
    for (const Crossing& crossing : record.ledger.crossings)
        json["crossings"].push_back(crossing_json(scene, crossing, {}));
    for (const TechniqueAtPixel& technique : techniques)
        json["techniques"].push_back(technique_json(scene, technique));
    return json;
}

} // namespace shadowproof
