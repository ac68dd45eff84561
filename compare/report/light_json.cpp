#include "compare/report/light_json.h"

#include "compare/judge/crossing_json.h"

#include <nlohmann/json.hpp>

namespace shadowproof {

nlohmann::ordered_json light_json(const Light& light) {
    nlohmann::ordered_json json{{"name", light.name}, {"kind", name_of(light.kind)}};
    if (light.kind != Light::Kind::directional) json["position"] = vector_json(light.position);
    if (light.kind != Light::Kind::point) json["direction"] = vector_json(light.direction);
    return json;
}

} // namespace shadowproof
