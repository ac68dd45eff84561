#include "reference/point_shader.h"

#include "scenes/relief.h"
#include "scenes/tangents.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

ShadingTables make_shading_tables(const Tracer& tracer) {
    const Tracer::State& state = tracer.state();
    const Scene& scene = *state.scene;
    ShadingTables tables;
    tables.state = &state;
    for (const Material& material : scene.materials)
        tables.slopes.push_back(
            material.bump == Bump::height_field
                ? slopes_of(scene.textures[material.bump_map], material.bump_scale)
                : Image<glm::dvec2>());
    const Light& light = chosen_light(scene);
    tables.light = state.light;
    if (light.kind == Light::Kind::directional)
        tables.light = glm::dvec4(glm::normalize(glm::dvec3(state.light)), 0);
    else
        tables.light = glm::dvec4(light.position - state.eye, 1);
    tables.light_color = scene.inverse_square ? light.color * light.intensity : light.color;
    tables.spot = light.kind == Light::Kind::spot;
    if (tables.spot) {
        tables.cos_outer = std::cos(light.outer_cone);
        tables.cone_scale = 1 / std::max(0.001, std::cos(light.inner_cone) - tables.cos_outer);
    }
    return tables;
}

namespace {

template <class T>
T blend(const glm::dvec3& weights, const std::array<T, 3>& values) {
    return weights.x * values[0] + weights.y * values[1] + weights.z * values[2];
}

/// v over its length; `otherwise` where that is zero.
template <class Otherwise>
glm::dvec3 unit(const glm::dvec3& v, const Otherwise& otherwise) {
    const double square = glm::dot(v, v);
    return square > 0 ? v * (1 / std::sqrt(square)) : otherwise();
}

double self_shadow(const glm::dvec3& v, const glm::dvec3& normal) {
    return std::clamp(8 * glm::dot(v, normal), 0.0, 1.0);
}

double eighth_power(double x) {
    const double x2 = x * x;
    const double x4 = x2 * x2;
    return x4 * x4;
}

} // namespace

void PointShader::learn(std::uint32_t triangle) {
    const Tracer::State& state = *tables_->state;
    const Scene& scene = *state.scene;
    const Mesh& mesh = scene.meshes[mesh_of(scene, triangle)];
    known_.triangle = triangle;
    known_.material = &scene.materials[mesh.material];
    known_.slopes = &tables_->slopes[mesh.material];
    known_.from_behind = state.from_eye.side[triangle] > 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Surface& surface = scene.surfaces[std::size_t{3} * triangle + k];
        known_.points[k] = corner(scene, triangle, static_cast<int>(k)) - state.eye;
        known_.normals[k] = surface.normal;
        known_.tangents[k] = glm::dvec3(surface.tangent);
        known_.decal_at[k] = surface.decal_at;
        known_.bump_at[k] = surface.bump_at;
    }
    known_.hand = scene.surfaces[std::size_t{3} * triangle].tangent.w;
    for (std::size_t k = 0; k < 3; ++k)
        known_.across[k] = glm::cross(known_.points[(k + 1) % 3], known_.points[(k + 2) % 3]);
}

/// m of the definition, of unit length.
glm::dvec3 PointShader::bump_sample(const glm::dvec2& at) const {
    const Material& material = *known_.material;
    const TextureImage& map = tables_->state->scene->textures[material.bump_map];
    const Taps s = taps_at(map.wrap_s, map.texels.width, at.x);
    const Taps t = taps_at(map.wrap_t, map.texels.height, at.y);
    glm::dvec3 m(0, 0, 1);
    if (material.bump == Bump::height_field) {
        const auto slope = sample<glm::dvec2>(*known_.slopes, s, t);
        m = {-slope.x, slope.y, 1};
    } else {
        m = 2.0 * sample<glm::dvec3>(map.texels, s, t) - 1.0;
        m.x *= material.bump_scale;
        m.y *= material.bump_scale;
    }
    return unit(m, [] { return glm::dvec3(0, 0, 1); });
}

glm::dvec3 PointShader::bumped(const glm::dvec3& weights, const glm::dvec3& normal) const {
    if (known_.material->bump == Bump::none) return normal;
    const glm::dvec3 along = blend(weights, known_.tangents);
    const glm::dvec3 tangent =
        unit(along - normal * glm::dot(normal, along), [&] { return any_tangent(normal); });
    const glm::dvec3 bitangent = known_.hand * glm::cross(normal, tangent);
    const glm::dvec3 m = bump_sample(blend(weights, known_.bump_at));
    return m.x * tangent + m.y * bitangent + m.z * normal;
}

void PointShader::set_decal(const glm::dvec3& weights, Shading& shading) const {
    const Material& material = *known_.material;
    shading.decal = material.color;
    if (material.decal == no_texture) return;
    const TextureImage& map = tables_->state->scene->textures[material.decal];
    const glm::dvec2 at = blend(weights, known_.decal_at);
    const auto sampled = sample<glm::dvec4>(map.texels, taps_at(map.wrap_s, map.texels.width, at.x),
                                            taps_at(map.wrap_t, map.texels.height, at.y));
    shading.decal *= glm::dvec3(sampled);
    if (material.gloss_in_alpha) shading.gloss = sampled.a;
}

void PointShader::set_light(const glm::dvec3& point, Shading& shading) const {
    const Scene& scene = *tables_->state->scene;
    shading.to_light = glm::dvec3(tables_->light);
    shading.light = tables_->light_color;
    if (tables_->light.w == 0) return;
    const glm::dvec3 way = shading.to_light - point;
    const double square = glm::dot(way, way);
    shading.to_light = square > 0 ? way * (1 / std::sqrt(square)) : glm::dvec3(0);
    if (scene.inverse_square) shading.light *= 1 / square;
    if (!tables_->spot) return;
    const double cosine = -glm::dot(shading.to_light, chosen_light(scene).direction);
    const double within = std::clamp((cosine - tables_->cos_outer) * tables_->cone_scale, 0.0, 1.0);
    shading.light *= within * within;
}

Shading PointShader::shade(const glm::dvec3& direction, std::uint32_t triangle, bool lit) {
    if (known_.triangle != triangle) learn(triangle);
    const glm::dvec3 sides(glm::dot(direction, known_.across[0]),
                           glm::dot(direction, known_.across[1]),
                           glm::dot(direction, known_.across[2]));
    const glm::dvec3 weights = sides * (1 / (sides.x + sides.y + sides.z));
    Shading shading;
    shading.lit = lit;
    shading.normal = unit(blend(weights, known_.normals), [&] {
        return glm::normalize(
            glm::cross(known_.points[1] - known_.points[0], known_.points[2] - known_.points[0]));
    });
    shading.bumped = bumped(weights, shading.normal);
    if (known_.from_behind) {
        shading.normal = -shading.normal;
        shading.bumped = -shading.bumped;
    }
    set_decal(weights, shading);
    shading.ambient_color = tables_->state->scene->ambient * shading.decal;
    set_light(blend(weights, known_.points), shading);
    const glm::dvec3 to_eye = -direction * (1 / std::sqrt(glm::dot(direction, direction)));
    shading.half = unit(shading.to_light + to_eye, [] { return glm::dvec3(0); });
    shading.self_shadow_light = self_shadow(shading.to_light, shading.normal);
    shading.self_shadow_half = self_shadow(shading.half, shading.normal);
    shading.diffuse =
        shading.self_shadow_light * std::max(0.0, glm::dot(shading.to_light, shading.bumped));
    shading.specular = shading.self_shadow_half *
                       eighth_power(std::max(0.0, glm::dot(shading.half, shading.bumped)));
    if (!lit) return shading;
    shading.diffuse_color = shading.light * shading.diffuse * shading.decal;
    shading.specular_color =
        shading.light * (shading.specular * shading.gloss) * known_.material->specular;
    return shading;
}

} // namespace shadowproof
