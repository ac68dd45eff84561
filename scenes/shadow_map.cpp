#include "scenes/shadow_map.h"

#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// Beyond, a spot's map would hold little but its border. 86 degrees.
constexpr double widest_cone = 1.5;

double farthest_caster(const Scene& scene, const glm::dvec3& light) {
    double farthest = 0;
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        for (int k = 0; k < 3 && casts[triangle] != 0; ++k)
            farthest = std::max(farthest, glm::distance(corner(scene, triangle, k), light));
    return farthest;
}

[[noreturn]] void refuse(const Scene& scene, const std::string& what, const std::string& remedy) {
    throw Error(scene.file.empty() ? scene.name : scene.file.string(), what, remedy);
}

} // namespace

MapModel with_settings(MapModel model, const MapSettings& settings, const Scene& scene) {
    const Light& light = chosen_light(scene);
    assert(light.kind != Light::Kind::directional);
    if (model.shape == MapModel::Shape::spot && light.outer_cone > widest_cone)
        refuse(scene, "has a spot whose cone is too wide for one map",
               "leave spot maps out, or make its outerConeAngle at most 1.5");
    constexpr double documents_bias = 0.15;
    model.size = settings.size.value_or(model.size);
    // Shaders take floats: what they compute with is what is predicted with.
    const auto in_float = [&](double value) {
        return double{static_cast<float>(value / scene.unit)};
    };
    model.bias = in_float(settings.bias.value_or(documents_bias));
    model.value = settings.value.value_or(model.value);
    model.format = settings.format.value_or(model.format);
    model.culling = settings.culling.value_or(model.culling);
    if (model.filter > 0) {
        model.filter = settings.filter.value_or(model.filter);
        model.average = settings.average.value_or(model.average);
    }
    // A light without casters has a map all the same.
    const double farthest = farthest_caster(scene, light.position) * scene.unit;
    // Window depths at the far plane are 2 near (far - depth) / far away from being clipped: 16
    // times what a float of that size rounds by.
    model.far = in_float(settings.far.value_or(farthest > 0 ? farthest * (1 + 0x1p-6) : 1));
    // Distances lose nothing to a near plane close to the light; depths do.
    const double share = model.value == MapValue::distance ? 0x1p-14 : 0x1p-10;
    model.near = in_float(settings.near.value_or(model.far * scene.unit * share));
    if (!(model.near > 0 && model.near < model.far))
        refuse(scene,
               fmt::format("has a light whose map would reach from {} to {}",
                           model.near * scene.unit, model.far * scene.unit),
               "give --map-near and --map-far so that 0 < near < far");
    return model;
}

double half_side_of_spot(const Light& light) {
    return std::tan(light.outer_cone);
}

Camera map_camera(const Light& light, const MapModel& model, std::size_t face) {
    Camera camera{.eye = light.position,
                  .near = model.near,
                  .far = model.far,
                  .width = model.size,
                  .height = model.size};
    if (model.shape == MapModel::Shape::cube) {
        const FaceAxes& axes = face_axes[face];
        camera.right = axes.s;
        camera.up = axes.t;
        camera.forward = axes.major;
        camera.tan_half_height = 1;
        return camera;
    }
    camera.forward = light.direction;
    const glm::dvec3 size = glm::abs(light.direction);
    const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    camera.right = glm::normalize(glm::cross(camera.forward, least));
    camera.up = glm::cross(camera.right, camera.forward);
    camera.tan_half_height = half_side_of_spot(light);
    return camera;
}

DepthModel map_depth_model(const MapModel& model) {
    return {.projection = DepthModel::Projection::finite,
            .near = model.near,
            .far = model.far,
            .floating = model.format == MapFormat::d32f,
            .eye_relative = true};
}

} // namespace shadowproof
