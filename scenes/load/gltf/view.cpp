#include "scenes/load/gltf/view.h"

#include "scenes/error.h"
#include "scenes/load/common/default_view.h"
#include "scenes/shadow_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace shadowproof::gltf {

namespace {

/// A node that carries a camera or a light, with the names by which it can be chosen.
struct Carrier {
    std::size_t node = 0;
    std::size_t index = 0; ///< of the camera or the light in the model
    Place place;           ///< of the same
    std::string name;
};

/// "camera 1 \"main\"" for messages and notes.
std::string described(const char* kind, std::size_t index, const Carrier& carrier) {
    return carrier.name.empty() ? fmt::format("{} {}", kind, index)
                                : fmt::format("{} {} \"{}\"", kind, index, carrier.name);
}

/// The one that `wanted` names: node name, own name, or number in the order of the scene.
std::optional<std::size_t> place_of(const std::vector<Carrier>& carriers, const NodeGraph& graph,
                                    const std::string& wanted) {
    for (std::size_t i = 0; i < carriers.size(); ++i)
        if (graph.nodes[carriers[i].node].name == wanted || carriers[i].name == wanted) return i;
    std::size_t index = 0;
    const char* const end = wanted.data() + wanted.size();
    const auto [parsed, failure] = std::from_chars(wanted.data(), end, index);
    if (failure == std::errc{} && parsed == end && index < carriers.size()) return index;
    return std::nullopt;
}

std::size_t find_named(const std::string& file, const char* kind,
                       const std::vector<Carrier>& carriers, const NodeGraph& graph,
                       const std::string& wanted) {
    if (const std::optional<std::size_t> place = place_of(carriers, graph, wanted)) return *place;
    std::string offered;
    for (std::size_t i = 0; i < carriers.size(); ++i)
        offered += (i == 0 ? "" : ", ") + described(kind, i, carriers[i]);
    throw Error(file, fmt::format("has no {} \"{}\"", kind, wanted),
                offered.empty() ? fmt::format("there is no {} in the scene", kind)
                                : "choose one of: " + offered);
}

std::vector<Carrier> find_cameras(const Document& document, const NodeGraph& graph) {
    std::vector<Carrier> carriers;
    for (const std::size_t node : graph.in_scene) {
        if (document.model.nodes[node].camera < 0) continue;
        const std::size_t index = as_index(document.model.nodes[node].camera);
        const std::string& own = document.model.cameras[index].name;
        carriers.push_back({node, index, document.root() / "cameras" / index,
                            own.empty() ? graph.nodes[node].name : own});
    }
    return carriers;
}

/// Pixels: as the request has it, or by the camera's aspect ratio, which `place` gives.
int picture_width(const Place& place, double aspect, const SceneRequest& request,
                  std::vector<std::string>& notes) {
    if (!request.camera_aspect || !(aspect > 0)) return request.width; // 0: there is none
    const double width = std::round(aspect * request.height);
    if (!(width >= 1 && width <= largest_side))
        place.refuse(fmt::format("an aspect ratio of {:g} makes a picture of {:g}x{} pixels",
                                 aspect, width, request.height),
                     "give its size by --size");
    if (width != request.width)
        notes.push_back(fmt::format("{:g}x{} pixels: the camera's aspect ratio is {:.4g} "
                                    "(--size for another picture)",
                                    width, request.height, aspect));
    return static_cast<int>(width);
}

/// The camera's own aspect ratio is that of the picture it was made for: another picture shows more
/// or less to the sides. They are the same where they differ by less than a pixel's width.
void note_aspect(double own, const Camera& camera, Scene& scene) {
    if (!(own > 0) || std::abs(own * camera.height - camera.width) < 1) return;
    scene.notes.push_back(fmt::format(
        "the camera's aspect ratio is {:.4g}, the picture's {:.4g}: {} from top to bottom{}", own,
        static_cast<double>(camera.width) / camera.height,
        camera.is_orthographic() ? "its ymag is kept" : "the field of view is kept",
        camera.is_orthographic() ? "" : ", as glTF says"));
}

void set_far(const Place& place, double far, Camera& camera) {
    camera.far = far;
    if (!(camera.far > camera.near))
        (place / "zfar")
            .refuse(fmt::format("{} is not above znear {}", camera.far, camera.near),
                    camera.is_orthographic() ? "move the far plane back"
                                             : "move the far plane back, or leave it out");
}

void read_perspective(const tinygltf::PerspectiveCamera& source, const Place& place,
                      const SceneRequest& request, Camera& camera, Scene& scene) {
    if (!(source.yfov > 0 && source.yfov < std::numbers::pi)) // radians
        (place / "yfov")
            .refuse(fmt::format("{} is not between 0 and pi", source.yfov), "write radians");
    camera.width = picture_width(place / "aspectRatio", source.aspectRatio, request, scene.notes);
    note_aspect(source.aspectRatio, camera, scene);
    camera.half_height = std::tan(source.yfov / 2);
    camera.near = source.znear;
    if (source.zfar > 0) set_far(place, source.zfar, camera); // 0: there is none
}

void read_orthographic(const tinygltf::OrthographicCamera& source, const Place& place,
                       const SceneRequest& request, Camera& camera, Scene& scene) {
    camera.projection = Projection::orthographic;
    if (source.xmag == 0 && source.ymag == 0)
        place.refuse("is missing, or has no extent: xmag and ymag are 0",
                     "write half of what the picture shows, in units of the scene");
    for (const auto& [name, half] : {std::pair("xmag", source.xmag), {"ymag", source.ymag}})
        if (!(half > 0))
            (place / name)
                .refuse(fmt::format("{} is not above 0", half),
                        "write half of what the picture shows, in units of the scene");
    if (!(source.znear >= 0))
        (place / "znear")
            .refuse(fmt::format("{} is negative", source.znear), "move the camera back instead");
    const double aspect = source.xmag / source.ymag;
    camera.width = picture_width(place, aspect, request, scene.notes);
    note_aspect(aspect, camera, scene);
    camera.half_height = source.ymag;
    camera.near = source.znear;
    set_far(place, source.zfar, camera);
}

bool is_perspective(const Document& document, const Carrier& carrier) {
    return document.model.cameras[carrier.index].type == "perspective";
}

Camera read_camera(const Document& document, const NodeGraph& graph, const Carrier& carrier,
                   const SceneRequest& request, Scene& scene) {
    const tinygltf::Camera& source = document.model.cameras[carrier.index];
    Camera camera;
    camera.height = request.height;
    if (is_perspective(document, carrier))
        read_perspective(source.perspective, carrier.place / "perspective", request, camera, scene);
    else
        read_orthographic(source.orthographic, carrier.place / "orthographic", request, camera,
                          scene);
    const glm::dmat4& world = graph.nodes[carrier.node].world_from_node;
    camera.eye = glm::dvec3(world[3]);
    if (!orient(camera, -glm::dvec3(world[2]), glm::dvec3(world[1])))
        graph.nodes[carrier.node].place.refuse(
            "has a transform that leaves its camera no direction",
            "use a transform without zero scale");
    return camera;
}

std::vector<Carrier> find_lights(const Document& document, const NodeGraph& graph) {
    const char* const extension = "KHR_lights_punctual";
    const Place lights = document.root() / "extensions" / extension / "lights";
    std::vector<Carrier> carriers;
    for (const std::size_t node : graph.in_scene) {
        if (!graph.nodes[node].visible) continue; // hides lights, but no cameras
        const tinygltf::ExtensionMap& extensions = document.model.nodes[node].extensions;
        const auto found = extensions.find(extension);
        if (found == extensions.end()) continue;
        const std::size_t index = as_index(found->second.Get("light").GetNumberAsInt());
        const std::string& own = document.model.lights[index].name;
        carriers.push_back(
            {node, index, lights / index, own.empty() ? graph.nodes[node].name : own});
    }
    return carriers;
}

Light::Kind light_kind(const Place& place, const std::string& type) {
    if (type == "point") return Light::Kind::point;
    if (type == "spot") return Light::Kind::spot;
    if (type == "directional") return Light::Kind::directional;
    place.refuse(fmt::format("\"{}\" is no light type", type),
                 "use \"point\", \"spot\" or \"directional\"");
}

void read_cones(const Place& place, const tinygltf::SpotLight& spot, Light& light) {
    light.inner_cone = spot.innerConeAngle;
    light.outer_cone = spot.outerConeAngle;
    if (!(light.inner_cone >= 0 && light.inner_cone < light.outer_cone &&
          light.outer_cone <= std::numbers::pi / 2))
        place.refuse(fmt::format("cone angles {} and {} do not satisfy 0 <= inner < outer <= pi/2",
                                 light.inner_cone, light.outer_cone),
                     "mend the angles");
}

Light read_light(const Document& document, const NodeGraph& graph, const Carrier& carrier) {
    const tinygltf::Light& source = document.model.lights[carrier.index];
    Light light;
    light.name = carrier.name;
    light.kind = light_kind(carrier.place / "type", source.type);
    if (!source.color.empty()) light.color = glm::make_vec3(source.color.data());
    light.intensity = source.intensity;
    if (source.range > 0) light.range = source.range;
    if (light.intensity < 0)
        (carrier.place / "intensity").refuse("is negative", "write candela, or lux");
    if (light.kind == Light::Kind::spot) read_cones(carrier.place / "spot", source.spot, light);
    const glm::dmat4& world = graph.nodes[carrier.node].world_from_node;
    light.position = glm::dvec3(world[3]);
    light.direction = glm::normalize(-glm::dvec3(world[2]));
    if (light.kind != Light::Kind::point &&
        !std::isfinite(glm::dot(light.direction, light.direction)))
        graph.nodes[carrier.node].place.refuse("has a transform that leaves its light no direction",
                                               "use a transform without zero scale");
    if (light.kind == Light::Kind::point) light.direction = {0, 0, -1}; // has no meaning
    return light;
}

void note_range(const Document& document, const Carrier& carrier, Scene& scene) {
    const double range = document.model.lights[carrier.index].range;
    if (range > 0)
        scene.notes.push_back(
            fmt::format("{}/range of {:g} is not evaluated: the light shines on "
                        "without end, and only a shadow map's far plane lies there",
                        carrier.place.pointer(), range));
}

void note_wide_cone(const Carrier& carrier, const Light& light, Scene& scene) {
    if (!fits_one_map(light))
        scene.notes.push_back(fmt::format("{}/spot/outerConeAngle of {:g} is too wide for one map, "
                                          "which spot maps need: they are left out unless named",
                                          carrier.place.pointer(), light.outer_cone));
}

} // namespace

Camera choose_camera(const Document& document, const NodeGraph& graph, const SceneRequest& request,
                     Scene& scene) {
    const std::vector<Carrier> cameras = find_cameras(document, graph);
    if (request.camera)
        return read_camera(
            document, graph,
            cameras[find_named(document.file, "camera", cameras, graph, *request.camera)], request,
            scene);
    if (cameras.empty()) return default_camera(request, scene);
    const auto first = std::ranges::find_if(
        cameras, [&](const Carrier& carrier) { return is_perspective(document, carrier); });
    if (first == cameras.end())
        return read_camera(document, graph, cameras.front(), request, scene);
    if (first != cameras.begin())
        scene.notes.push_back(fmt::format(
            "orthographic cameras come first, and fewer techniques draw what they see: {} is used "
            "(--camera for another)",
            described("camera", static_cast<std::size_t>(first - cameras.begin()), *first)));
    return read_camera(document, graph, *first, request, scene);
}

void choose_light(const Document& document, const NodeGraph& graph, const SceneRequest& request,
                  Scene& scene) {
    const std::vector<Carrier> lights = find_lights(document, graph);
    if (request.light)
        scene.light = find_named(document.file, "light", lights, graph, *request.light);
    for (const Carrier& carrier : lights) {
        Light& light = scene.lights.emplace_back(read_light(document, graph, carrier));
        const std::size_t number = scene.lights.size() - 1;
        const bool is_told_by_name =
            !light.name.empty() && place_of(lights, graph, light.name) == number;
        light.choice = is_told_by_name ? light.name : std::to_string(number);
    }
    if (lights.empty()) add_default_light(scene);
    // Where bumps are lit, those before it count, too.
    if (!lights.empty())
        for (std::size_t i = 0; i <= scene.light; ++i) note_range(document, lights[i], scene);
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (request.every_light || i <= scene.light)
            note_wide_cone(lights[i], scene.lights[i], scene);
    if (lights.size() > 1 && !request.every_light)
        scene.notes.push_back(fmt::format("{} lights in the file: {} is judged", lights.size(),
                                          described("light", scene.light, lights[scene.light])));
}

} // namespace shadowproof::gltf
