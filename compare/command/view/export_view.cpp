#include "compare/command/commands.h"
#include "compare/command/guard.h"
#include "compare/command/output_files.h"
#include "compare/command/process/exit_code.h"
#include "compare/command/process/standard_output.h"
#include "compare/output/write_file.h"
#include "scenes/engines/engine_code.h"
#include "scenes/load/admission.h"
#include "scenes/load/catalog.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>

namespace shadowproof {

namespace {

using Json = nlohmann::ordered_json;

struct ExportOptions {
    std::string scene;
    SceneOptions picture;
    std::vector<const Convention*> engines; ///< empty: all
    std::string output;                     ///< empty: the console
    double timeout = 600;                   ///< seconds; 0: any number
};

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

std::string_view name_of(DepthRange range) {
    switch (range) {
    case DepthRange::minus_one_to_one:
        return "-1 to 1";
    case DepthRange::zero_to_one:
        return "0 to 1";
    case DepthRange::one_to_zero:
        break;
    }
    return "1 to 0";
}

Json as_json(const Convention& convention, const Scene& scene) {
    const EngineView view = view_in(convention, scene);
    const bool is_point = chosen_light(scene).kind == Light::Kind::point;
    Json json{{"engine", convention.engine},
              {"axes", convention.axes},
              {"units", convention.units},
              {"world_from_gltf", rows(view.world_from_gltf)}};
    json["camera"] = {
        {"position", numbers(view.position)},
        {"rotation", numbers(view.rotation)},
        {"field_of_view",
         {{"engine_takes", convention.horizontal_field_of_view ? "horizontal" : "vertical"},
          {"vertical_degrees", glm::degrees(view.vertical_field_of_view)},
          {"horizontal_degrees", glm::degrees(view.horizontal_field_of_view)}}},
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

Json as_json(const ExportOptions& options, const Scene& scene) {
    const Camera& camera = scene.camera;
    const Light& light = chosen_light(scene);
    Json json{{"schema", "shadowproof/view/1"},
              {"scene", scene.name},
              {"file", std::filesystem::absolute(scene.file).string()},
              {"width", camera.width},
              {"height", camera.height},
              {"time", options.picture.time},
              {"notes", scene.notes}};
    glm::dmat4 world_from_camera(glm::dmat3(camera.right, camera.up, -camera.forward));
    world_from_camera[3] = glm::dvec4(camera.eye, 1);
    Json matrix = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) matrix.push_back(world_from_camera[column][row]);
    json["camera"] = {{"matrix", matrix},
                      {"yfov", 2 * std::atan(camera.tan_half_height)},
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
        if (options.engines.empty() || std::find(options.engines.begin(), options.engines.end(),
                                                 &convention) != options.engines.end())
            json["engines"][std::string(convention.name)] = as_json(convention, scene);
    return json;
}

int export_view(const ExportOptions& options) {
    if (!options.output.empty()) {
        check_writable(options.output);
        check_apart(std::array{options.output}, std::array{options.scene});
    }
    const Scene scene = in_file_units(load_scene(options.scene, options.picture.request()));
    const std::string text =
        as_json(options, scene).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
        "\n";
    if (options.output.empty())
        print(text);
    else
        write_file(options.output, text);
    return exit_passed;
}

std::string engine_names() {
    std::string names;
    for (const Convention& convention : conventions())
        names += (names.empty() ? "" : ", ") + std::string(convention.name);
    return names;
}

const Convention* parse_engine(const std::string& name) {
    const auto& all = conventions();
    const auto* const found =
        std::find_if(all.begin(), all.end(),
                     [&](const Convention& convention) { return convention.name == name; });
    if (found == all.end())
        throw CLI::ValidationError(
            "--engine", fmt::format("'{}' is not known; there are {}", name, engine_names()));
    return found;
}

} // namespace

Work add_export_view(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "export-view", "A scene's camera and light in other engines' conventions, as JSON");
    const auto options = std::make_shared<ExportOptions>();
    add_scene_argument(*command, options->scene);
    command
        ->add_option_function<std::vector<std::string>>(
            "--engine",
            [options](const std::vector<std::string>& names) {
                options->engines.clear();
                for (const std::string& name : names)
                    options->engines.push_back(parse_engine(name));
            },
            "Engines, separated by commas: " + engine_names() + " (all)")
        ->delimiter(',')
        ->allow_extra_args(false) // a scene may follow
        ->type_name("A,B");
    command->add_option("-o,--output", options->output, "Write it here, not to the console")
        ->type_name("FILE")
        ->check(not_empty());
    add_scene_flags(*command, options->picture);
    add_timeout_flag(*command, options->timeout,
                     "Seconds above which it is given up (600; 0: any number)");
    return [options] {
        return guarded_within(options->timeout, options->scene,
                              [&](int /*watcher*/) { return export_view(*options); });
    };
}

} // namespace shadowproof
