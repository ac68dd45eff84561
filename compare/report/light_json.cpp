#include "compare/report/light_json.h"

#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

nlohmann::ordered_json vector_json(const glm::dvec3& v) {
    return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

} // namespace

nlohmann::ordered_json light_json(const Light& light) {
    nlohmann::ordered_json json{{"name", light.name}, {"kind", name_of(light.kind)}};
    if (light.kind != Light::Kind::directional) json["position"] = vector_json(light.position);
    if (light.kind != Light::Kind::point) json["direction"] = vector_json(light.direction);
    return json;
}

} // namespace shadowproof
