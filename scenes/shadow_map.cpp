#include "scenes/shadow_map.h"

#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

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

/// Right, up and forward of a camera that looks along a unit vector.
std::array<glm::dvec3, 3> axes_along(const glm::dvec3& forward) {
    const glm::dvec3 size = glm::abs(forward);
    const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, least));
    return {right, glm::cross(right, forward), forward};
}

[[noreturn]] void refuse(const Scene& scene, const std::string& what, const std::string& remedy) {
    throw Error(scene.file.empty() ? scene.name : scene.file.string(), what, remedy);
}

} // namespace

void fit_sun(MapModel& model, const Scene& scene) {
    const std::vector<std::uint8_t> casts = casting_triangles(scene);
    const std::vector<std::uint8_t> receives = receiving_triangles(scene);
    const auto [right, up, forward] = axes_along(chosen_light(scene).direction);
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle)
        for (int k = 0; k < 3 && (casts[triangle] != 0 || receives[triangle] != 0); ++k) {
            const glm::dvec3 point = corner(scene, triangle, k);
            const glm::dvec3 place(glm::dot(right, point), glm::dot(up, point),
                                   glm::dot(forward, point));
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
    if (!(low.x <= high.x)) low = high = glm::dvec3(0);
    const glm::dvec3 extent = high - low;
    const double size = std::max({extent.x, extent.y, extent.z});
    const double margin = 0x1p-6 * (size > 0 ? size : 1 / scene.unit);
    const glm::dvec3 middle = 0.5 * (low + high);
    model.eye = middle.x * right + middle.y * up + (low.z - 2 * margin) * forward;
    model.half_side = 0.5 * std::max(extent.x, extent.y) + 0.25 * margin;
    model.near = margin;
    model.far = extent.z + 3 * margin;
}

bool fits_one_map(const Light& light) {
    return light.kind != Light::Kind::spot || light.outer_cone <= widest_cone;
}

MapModel with_settings(MapModel model, const MapSettings& settings, const Scene& scene) {
    const Light& light = chosen_light(scene);
    const bool is_sun = model.shape == MapModel::Shape::sun;
    assert(is_sun == (light.kind == Light::Kind::directional));
    if (model.shape == MapModel::Shape::spot && !fits_one_map(light))
        refuse(scene, "has a spot whose cone is too wide for one map",
               "leave spot maps out, or make its outerConeAngle at most 1.5");
    constexpr double documents_bias = 0.15;
    model.size = settings.size.value_or(model.size);
    // Shaders take floats: what they compute with is what is predicted with.
    const auto in_float = [&](double value) {
        return double{static_cast<float>(value / scene.unit)};
    };
    model.bias = in_float(settings.bias.value_or(documents_bias));
    if (!is_sun && !model.is_ramp()) model.value = settings.value.value_or(model.value);
    // A ramp's texels are colours, which no polygon offset moves.
    if (!model.is_ramp()) {
        model.slope_bias = double{static_cast<float>(settings.slope_bias.value_or(0))};
        model.offset_units = double{static_cast<float>(settings.offset_units.value_or(0))};
    }
    if (model.has_offset() && model.value == MapValue::distance)
        refuse(scene,
               fmt::format("would have a shadow map of distances, which {} does not move: it is a "
                           "polygon offset, of window depths",
                           model.slope_bias != 0 ? "--map-slope-bias" : "--map-offset-units"),
               "give --map-value depth, or leave the polygon offset out");
    if (!model.is_ramp()) model.format = settings.format.value_or(model.format);
    model.culling = settings.culling.value_or(model.culling);
    if (model.filter > 0) {
        model.filter = settings.filter.value_or(model.filter);
        model.average = settings.average.value_or(model.average);
        model.edges = settings.edges.value_or(model.edges);
    }
    if (is_sun) {
        fit_sun(model, scene);
        model.far = in_float(settings.far.value_or(model.far * scene.unit));
        model.near = in_float(settings.near.value_or(model.near * scene.unit));
    } else {
        // A light without casters has a map all the same.
        // Window depths at the far plane are 2 near (far - depth) / far away from being clipped: 16
        // times what a float of that size rounds by.
        const double farthest = farthest_caster(scene, light.position) * scene.unit * (1 + 0x1p-6);
        const double reach = std::isfinite(light.range) ? light.range * scene.unit : farthest;
        model.far = in_float(settings.far.value_or(reach > 0 ? reach : 1));
        // Distances lose nothing to a near plane close to the light; depths do.
        const double share = model.value == MapValue::distance ? 0x1p-14 : 0x1p-10;
        model.near = in_float(settings.near.value_or(model.far * scene.unit * share));
    }
    if (!(model.near > 0 && model.near < model.far))
        refuse(scene,
               fmt::format("would have a shadow map that reaches from {:.6g} to {:.6g}",
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
        camera.half_height = 1;
        return camera;
    }
    const auto [right, up, forward] = axes_along(light.direction);
    camera.right = right;
    camera.up = up;
    camera.forward = forward;
    if (model.shape == MapModel::Shape::sun) {
        camera.projection = Projection::orthographic;
        camera.eye = model.eye;
        camera.half_height = model.half_side;
    } else {
        camera.half_height = half_side_of_spot(light);
    }
    return camera;
}

glm::dvec2 place_in_map(const MapModel& model, const Camera& camera, const glm::dvec3& from_eye) {
    if (model.shape != MapModel::Shape::sun) return project(camera, camera.eye + from_eye);
    const double half = 0.5 * model.size;
    return {(1 + glm::dot(from_eye, camera.right) / model.half_side) * half,
            (1 - glm::dot(from_eye, camera.up) / model.half_side) * half};
}

double map_window_depth(const MapModel& model, double depth) {
    if (model.shape == MapModel::Shape::sun) return (depth - model.near) / (model.far - model.near);
    return model.far / (model.far - model.near) * (1 - model.near / depth);
}

double place_on_ramp(const MapModel& model, double depth) {
    return (depth - model.near) / (model.far - model.near);
}

int ramp_step(double place) {
    return static_cast<int>(std::clamp(std::floor(ramp_steps * place), 0.0, ramp_steps - 1.0));
}

double value_of_stored(const MapModel& model, double stored) {
    if (model.value == MapValue::distance) return stored * model.far;
    const double n = model.near;
    const double f = model.far;
    if (model.is_ramp()) {
        const double step = std::round(stored * (ramp_steps - 1));
        return n + (step + 0.5) / ramp_steps * (f - n);
    }
    if (model.shape == MapModel::Shape::sun) return n + stored * (f - n);
    return n * f / (f - stored * (f - n));
}

DepthModel map_depth_model(const MapModel& model) {
    return {.projection = DepthModel::Projection::finite,
            .near = model.near,
            .far = model.far,
            .floating = model.format == MapFormat::d32f,
            .eye_relative = true};
}

} // namespace shadowproof
