#include "compare/command/view/view_json.h"

#include "scenes/camera.h"
#include "scenes/engines/engine_code.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace shadowproof {

using Json = nlohmann::ordered_json;

namespace {

Json numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json numbers(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

/// Four rows.
Json rows(const glm::dmat4& matrix) {
    Json all = Json::array();
    for (int row = 0; row < 4; ++row)
        all.push_back({matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]});
    return all;
}

Json length_or_null(const std::optional<double>& length) {
    return length ? Json(*length) : Json(nullptr);
}

std::string_view name_of(NdcDepth range) {
    switch (range) {
    case NdcDepth::minus_one_to_one:
        return "-1 to 1";
    case NdcDepth::zero_to_one:
        return "0 to 1";
    case NdcDepth::one_to_zero:
        break;
    }
    return "1 to 0";
}

/// Null of an orthographic camera, which has an extent instead.
Json field_of_view_json(const Convention& convention, const EngineView& view) {
    if (view.extent) return nullptr;
    return {{"engine_takes", convention.horizontal_field_of_view ? "horizontal" : "vertical"},
            {"vertical_degrees", glm::degrees(view.vertical_field_of_view)},
            {"horizontal_degrees", glm::degrees(view.horizontal_field_of_view)}};
}

Json as_json(const Convention& convention, const Scene& scene) {
    const EngineView view = view_in(convention, scene);
    const bool is_point = chosen_light(scene).kind == Light::Kind::point;
    Json json{{"engine", convention.engine},
              {"axes", convention.axes},
              {"units", convention.units},
              {"world_from_gltf", rows(view.world_from_gltf)}};
    json["camera"] = {{"position", numbers(view.position)},
                      {"rotation", numbers(view.rotation)},
                      {"field_of_view", field_of_view_json(convention, view)},
                      {"extent", view.extent
                                     ? Json{{"width", view.extent->x}, {"height", view.extent->y}}
                                     : Json(nullptr)},
                      {"near", view.near},
                      {"far", length_or_null(view.far)},
                      {"far_is_made_up", view.far_is_made_up},
                      {"depth", name_of(convention.depth_range)},
                      {"world_from_camera", rows(view.world_from_camera)},
                      {"view_from_world", rows(view.view_from_world)},
                      {"clip_from_view", rows(view.clip_from_view)}};
    if (convention.name == "unreal")
        json["camera"]["pitch_yaw_roll"] = numbers(unreal_rotator(view.rotation));
    json["light"] = {{"position", numbers(view.light_position)},
                     {"direction", is_point ? Json(nullptr) : numbers(view.light_direction)},
                     {"rotation", is_point ? Json(nullptr) : numbers(view.light_rotation)}};
    json["code"] = engine_code(convention, scene, view);
    return json;
}

} // namespace

Json view_json(const Scene& scene, double time, const std::vector<const Convention*>& engines) {
    const Camera& camera = scene.camera;
    const Light& light = chosen_light(scene);
    Json json{{"schema", "shadowproof/view/1"},
              {"scene", scene.name},
              {"file", std::filesystem::absolute(scene.file).string()},
              {"width", camera.width},
              {"height", camera.height},
              {"time", time},
              {"notes", scene.notes}};
    glm::dmat4 world_from_camera(glm::dmat3(camera.right, camera.up, -camera.forward));
    world_from_camera[3] = glm::dvec4(camera.eye, 1);
    Json matrix = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) matrix.push_back(world_from_camera[column][row]);
    const bool is_parallel = camera.is_orthographic();
    const Json yfov = is_parallel ? Json(nullptr) : Json(2 * std::atan(camera.half_height));
    const glm::dvec2 half = half_extent(camera);
    const Json extent =
        is_parallel ? Json{{"width", 2 * half.x}, {"height", 2 * half.y}} : Json(nullptr);
    json["camera"] = {{"matrix", matrix},
                      {"yfov", yfov},
                      {"extent", extent},
                      {"znear", camera.near},
                      {"zfar", std::isfinite(camera.far) ? Json(camera.far) : Json(nullptr)}};
    json["light"] = {
        {"name", light.name},
        {"kind", name_of(light.kind)},
        {"position", numbers(light.position)},
        {"direction", light.kind == Light::Kind::point ? Json(nullptr) : numbers(light.direction)}};
    if (light.kind == Light::Kind::spot)
        json["light"].update({{"inner_cone_degrees", glm::degrees(light.inner_cone)},
                              {"outer_cone_degrees", glm::degrees(light.outer_cone)}});
    for (const Convention& convention : conventions())
        if (engines.empty() ||
            std::find(engines.begin(), engines.end(), &convention) != engines.end())
            json["engines"][std::string(convention.name)] = as_json(convention, scene);
    return json;
}

} // namespace shadowproof
