#include "reference/shade/point_shader.h"

#include "scenes/spot_cone.h"
#include "scenes/surface/relief.h"
#include "scenes/surface/tangents.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

LaneLight lane_light(const Tracer::State& state) {
    const Light& light = chosen_light(*state.scene);
    LaneLight lanes;
    lanes.to = glm::dvec4(light.position - state.scene->camera.eye, 1);
    if (light.kind == Light::Kind::directional)
        lanes.to = glm::dvec4(glm::normalize(glm::dvec3(state.light)), 0);
    lanes.axis = light.direction;
    lanes.inverse_square = state.scene->inverse_square;
    lanes.highlight = state.scene->highlight;
    lanes.spot = light.kind == Light::Kind::spot;
    if (lanes.spot) {
        const SpotCone cone = spot_cone(light);
        lanes.cos_outer = cone.cos_outer;
        lanes.cone_scale = cone.scale;
    }
    return lanes;
}

/// Rounding must not move a point outside its triangle; NaN counts as 0.
double share(double weight) {
    return weight > 0 ? std::min(weight, 1.0) : 0;
}

template <class T>
T blend(const glm::dvec3& weights, const std::array<T, 3>& values) {
    return weights.x * values[0] + weights.y * values[1] + weights.z * values[2];
}

} // namespace

ShadingTables make_shading_tables(const Tracer& tracer) {
    const Scene& scene = tracer.scene();
    auto slopes = std::make_shared<std::vector<Image<glm::dvec2>>>();
    for (const Material& material : scene.materials)
        slopes->push_back(material.bump == Bump::height_field
                              ? slopes_of(scene.textures[material.bump_map], material.bump_scale)
                              : Image<glm::dvec2>());
    ShadingTables tables;
    tables.slopes = std::move(slopes);
    return make_shading_tables(tracer, tables);
}

ShadingTables make_shading_tables(const Tracer& tracer, const ShadingTables& other) {
    const Tracer::State& state = tracer.state();
    const Scene& scene = *state.scene;
    assert(is_bump_lit(scene));
    ShadingTables tables;
    tables.state = &state;
    tables.slopes = other.slopes;
    tables.light = lane_light(state);
    const Light& light = chosen_light(scene);
    tables.light_color = scene.inverse_square ? light.color * light.intensity : light.color;
    return tables;
}

const PointShader::Known& PointShader::known(std::uint32_t triangle) {
    Known& place = known_[triangle % kept_triangles];
    if (place.triangle != triangle) learn(triangle, place);
    return place;
}

void PointShader::learn(std::uint32_t triangle, Known& known) const {
    const Tracer::State& state = *tables_->state;
    const Scene& scene = *state.scene;
    const Mesh& mesh = scene.meshes[mesh_of(scene, triangle)];
    known.triangle = triangle;
    known.material = &scene.materials[mesh.material];
    known.slopes = &(*tables_->slopes)[mesh.material];
    known.side = state.from_eye.side[triangle] > 0 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Surface& surface = scene.surfaces[std::size_t{3} * triangle + k];
        known.normals[k] = surface.normal;
        known.tangents[k] = glm::dvec3(surface.tangent);
        known.decal_at[k] = surface.decal_at;
        known.bump_at[k] = surface.bump_at;
    }
    if (known.material->height_in_space) known.texel = texel_sides(scene, triangle);
    known.hand = scene.surfaces[std::size_t{3} * triangle].tangent.w;
    const glm::dvec3 a = corner(scene, triangle, 0);
    known.point = a - scene.camera.eye;
    known.edge_b = corner(scene, triangle, 1) - a;
    known.edge_c = corner(scene, triangle, 2) - a;
    known.across = glm::cross(known.edge_b, known.edge_c);
    known.toward_b = glm::cross(known.edge_c, known.point);
    known.toward_c = glm::cross(known.point, known.edge_b);
}

/// m of the definition, not yet normalised.
glm::dvec3 PointShader::bump_at(const Known& known, const glm::dvec3& weights) const {
    const Material& material = *known.material;
    if (material.bump == Bump::none) return {0, 0, 1};
    const TextureImage& map = tables_->state->scene->textures[material.bump_map];
    const glm::dvec2 at = blend(weights, known.bump_at);
    const Taps s = taps_at(map.wrap_s, map.texels.width, at.x);
    const Taps t = taps_at(map.wrap_t, map.texels.height, at.y);
    if (material.bump == Bump::height_field) {
        const auto slope = sample<glm::dvec2>(*known.slopes, s, t);
        return {-slope.x, slope.y, 1};
    }
    const glm::dvec3 m = 2.0 * sample<glm::dvec3>(map.texels, s, t) - 1.0;
    return {m.x * material.bump_scale, m.y * material.bump_scale, m.z};
}

/// G of the definition; zero where heights are in texels. `bump`: m.
glm::dvec3 PointShader::gradient(const Known& known, const glm::dvec3& normal,
                                 const glm::dvec3& bump) const {
    if (!known.material->height_in_space) return glm::dvec3(0);
    const glm::dvec3 unit = normal * (1 / std::sqrt(glm::dot(normal, normal)));
    return height_gradient(known.texel, unit, {-bump.x, bump.y});
}

PointShader::Look PointShader::look_at(const Known& known, const glm::dvec3& weights) const {
    const Material& material = *known.material;
    Look look{&material, material.color};
    if (material.decal == no_texture) return look;
    const TextureImage& map = tables_->state->scene->textures[material.decal];
    const glm::dvec2 at = blend(weights, known.decal_at);
    const auto sampled = sample<glm::dvec4>(map.texels, taps_at(map.wrap_s, map.texels.width, at.x),
                                            taps_at(map.wrap_t, map.texels.height, at.y));
    look.decal *= glm::dvec3(sampled);
    if (material.gloss_in_alpha) look.gloss = sampled.a;
    return look;
}

void PointShader::set(std::size_t lane, const glm::dvec3& line, std::uint32_t triangle, bool lit) {
    const Known& seen = known(triangle);
    const Scene& scene = *tables_->state->scene;
    const Camera& camera = scene.camera;
    const glm::dvec3& direction = direction_of(camera, line);
    const bool is_parallel = camera.is_orthographic();
    const glm::dvec3 from_line =
        is_parallel ? corner(scene, triangle, 0) - start_of(camera, line) : glm::dvec3(0);
    const double all = 1 / glm::dot(direction, seen.across);
    const auto weight = [&](const glm::dvec3& toward) {
        return share(glm::dot(direction, toward) * all);
    };
    const double b = weight(is_parallel ? glm::cross(seen.edge_c, from_line) : seen.toward_b);
    const double c = weight(is_parallel ? glm::cross(from_line, seen.edge_b) : seen.toward_c);
    const glm::dvec3 weights(1 - b - c, b, c);
    glm::dvec3 normal = blend(weights, seen.normals);
    if (!(glm::dot(normal, normal) > 0)) normal = seen.across;
    lanes_.direction.set(lane, direction);
    lanes_.point.set(lane, seen.point + b * seen.edge_b + c * seen.edge_c);
    lanes_.normal.set(lane, normal);
    lanes_.tangent.set(lane, blend(weights, seen.tangents));
    const glm::dvec3 bump = bump_at(seen, weights);
    lanes_.gradient.set(lane, gradient(seen, normal, bump));
    lanes_.in_space[lane] = seen.material->height_in_space ? 1 : 0;
    lanes_.bump.set(lane, bump);
    lanes_.hand[lane] = seen.hand;
    lanes_.side[lane] = seen.side;
    looks_[lane] = look_at(seen, weights);
    looks_[lane].lit = lit;
    looks_[lane].weights = weights;
}

/// Step 10 of the definition.
glm::dvec3 PointShader::reflection(std::size_t lane) const {
    const Scene& scene = *tables_->state->scene;
    const Look& look = looks_[lane];
    if (!scene.environment || look.material->reflectance == glm::dvec3(0)) return glm::dvec3(0);
    const glm::dvec3 direction = lanes_.direction.at(lane);
    const glm::dvec3 to_eye = -(direction * (1 / std::sqrt(glm::dot(direction, direction))));
    const glm::dvec3 bumped = lanes_.bumped.at(lane);
    const glm::dvec3 reflected = 2 * glm::dot(bumped, to_eye) * bumped - to_eye;
    return look.material->reflectance * look.gloss *
           sample<glm::dvec3>(*scene.environment, reflected);
}

PointShader::Summands PointShader::summands(std::size_t lane) const {
    const Look& look = looks_[lane];
    const glm::dvec3 ambient = tables_->state->scene->ambient * look.decal;
    const glm::dvec3 reflected = reflection(lane);
    if (!look.lit) return {glm::dvec3(0), glm::dvec3(0), ambient, reflected};
    const glm::dvec3 light = tables_->light_color * lanes_.strength[lane];
    return {light * lanes_.diffuse[lane] * look.decal,
            light * (lanes_.specular[lane] * look.gloss) * look.material->specular, ambient,
            reflected};
}

/// T of the definition, step 2. Computed by squares of components as in lighting_lanes.cpp, which
/// does not return T: most pictures need none. N's sign does not matter to it.
glm::dvec3 PointShader::tangent(std::size_t lane) const {
    if (looks_[lane].material->bump == Bump::none) return glm::dvec3(0);
    const glm::dvec3 normal = lanes_.normal.at(lane);
    const glm::dvec3 interpolated = lanes_.tangent.at(lane);
    const glm::dvec3 across = interpolated - normal * glm::dot(normal, interpolated);
    const double square = glm::dot(across, across);
    return square > 0 ? across * (1 / std::sqrt(square)) : any_tangent(normal);
}

glm::dvec3 PointShader::color(std::size_t lane) const {
    const Summands sum = summands(lane);
    return sum.diffuse + sum.ambient + sum.specular + sum.reflection;
}

glm::dvec3 PointShader::added_color(std::size_t lane) const {
    const Summands sum = summands(lane);
    return sum.diffuse + sum.specular;
}

Shading PointShader::terms(std::size_t lane) const {
    const Look& look = looks_[lane];
    const Summands sum = summands(lane);
    return {.normal = lanes_.normal.at(lane),
            .tangent = tangent(lane),
            .bumped = lanes_.bumped.at(lane),
            .to_light = lanes_.to_light.at(lane),
            .half = lanes_.half.at(lane),
            .self_shadow_light = lanes_.self_shadow_light[lane],
            .self_shadow_half = lanes_.self_shadow_half[lane],
            .diffuse = lanes_.diffuse[lane],
            .specular = lanes_.specular[lane],
            .gloss = look.gloss,
            .decal = look.decal,
            .light = tables_->light_color * lanes_.strength[lane],
            .lit = look.lit,
            .point = lanes_.point.at(lane),
            .weights = look.weights,
            .hand = lanes_.hand[lane],
            .side = lanes_.side[lane],
            .diffuse_color = sum.diffuse,
            .specular_color = sum.specular,
            .ambient_color = sum.ambient,
            .reflection_color = sum.reflection};
}

} // namespace shadowproof
