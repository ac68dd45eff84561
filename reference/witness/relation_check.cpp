#include "reference/witness/relation_check.h"

#include "scenes/relations/relation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

constexpr std::string_view exchange = "exchanged";

/// A scene in which the one pixel sees the point `at`, upon a small triangle made for it, and the
/// light is at `light`.
std::optional<Scene> looking_at(const Scene& scene, const glm::vec3& at, const glm::vec3& light) {
    const glm::dvec3 to_light = glm::dvec3(light) - glm::dvec3(at);
    const glm::dvec3 size = glm::abs(to_light);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    if (size[axis] == 0) return std::nullopt;
    const double side = to_light[axis] > 0 ? 1 : -1;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;

    // The triangle lies in a plane of the axes through the point, whatever its corners round to,
    // and holds it as long as they do not round away a step of 2^-10 of the coordinates.
    double largest = size[axis];
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(double{at[k]}));
    const double step = std::ldexp(1.0, std::ilogb(largest) - 10);
    Scene asked = scene;
    asked.surfaces.clear();
    asked.textures.clear();
    const auto first = static_cast<std::uint32_t>(asked.positions.size());
    for (const glm::dvec2& corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(0, 1)}) {
        glm::dvec3 position(at);
        position[u] += step * corner.x;
        position[v] += step * corner.y;
        asked.positions.emplace_back(position);
    }
    if (has_masks(asked)) asked.mask_at.resize(asked.positions.size());
    const auto triangle = static_cast<std::uint32_t>(asked.triangles.size());
    asked.triangles.emplace_back(first, first + 1, first + 2);
    asked.meshes.push_back({.name = "the point",
                            .first_triangle = triangle,
                            .triangle_count = 1,
                            .material = static_cast<std::uint32_t>(asked.materials.size()),
                            .casts = false});
    asked.materials.push_back({.name = "the point", .double_sided = true});

    // The eye is a step before the point. Nothing but what is there lies between its planes.
    Camera& camera = asked.camera;
    camera = {};
    camera.eye = at;
    camera.eye[axis] += side * step;
    if (camera.eye[axis] - side * step != at[axis]) return std::nullopt;
    camera.forward = camera.right = camera.up = {0, 0, 0};
    camera.forward[axis] = -side;
    camera.right[side > 0 ? u : v] = 1;
    camera.up[side > 0 ? v : u] = 1;
    camera.near = step * (1 - 0x1p-20);
    camera.far = step * (1 + 0x1p-20);
    camera.width = camera.height = 1;
    asked.lights = {{.name = "the other point", .position = light}};
    asked.light = 0;
    return asked;
}

/// Whether the light reaches the point.
std::optional<bool> reaches(const Scene& scene, const glm::vec3& at, const glm::vec3& light) {
    const std::optional<Scene> asked = looking_at(scene, at, light);
    if (!asked) return std::nullopt;
    const Tracer tracer(*asked, 1);
    const RayTruth truth = trace_ray(tracer, line_of_sight(asked->camera, 0.5, 0.5));
    if (truth.triangle + 1 != asked->triangles.size()) return std::nullopt;
    return truth.visibility == Visibility::lit;
}

std::string seen_words(Visibility visibility, std::uint32_t triangle) {
    if (triangle == no_triangle) return "background";
    return fmt::format("triangle {}, {}", triangle, name_of(visibility));
}

void note_change(RelationCheck& check, const std::string& words) {
    if (check.changed++ == 0) check.first = words;
}

void compare(RelationCheck& check, std::string_view relation, const ChangedScene& changed,
             const GroundTruth& before, int threads) {
    const GroundTruth after = trace(Tracer(changed.scene, threads));
    for (int y = 0; y < before.visibility.height; ++y)
        for (int x = 0; x < before.visibility.width; ++x) {
            const std::uint32_t number = after.triangle.at(x, y);
            const std::uint32_t seen =
                number == no_triangle ? no_triangle : changed.original[number];
            ++check.compared;
            if (seen == before.triangle.at(x, y) &&
                after.visibility.at(x, y) == before.visibility.at(x, y))
                continue;
            if (before.exactness.at(x, y) == Exactness::degenerate ||
                after.exactness.at(x, y) == Exactness::degenerate)
                ++check.ties;
            else
                note_change(check, fmt::format("{}: ({},{}) was {}, and is {}", relation, x, y,
                                               seen_words(before.visibility.at(x, y),
                                                          before.triangle.at(x, y)),
                                               seen_words(after.visibility.at(x, y), seen)));
        }
}

/// The eye and the light change places.
void check_exchange(RelationCheck& check, const Scene& scene) {
    const Light& light = chosen_light(scene);
    const bool is_parallel =
        light.kind == Light::Kind::directional || scene.camera.is_orthographic();
    const auto both =
        is_parallel ? std::nullopt : mutual_visibility(scene, scene.camera.eye, light.position);
    (both ? check.tried : check.left_out).emplace_back(exchange);
    if (both && (*both)[0] != (*both)[1])
        note_change(check, fmt::format("{}: the light {} the eye, and {} where both change places",
                                       exchange, (*both)[0] ? "reaches" : "does not reach",
                                       (*both)[1] ? "does" : "does not"));
}

} // namespace

std::optional<std::array<bool, 2>> mutual_visibility(const Scene& scene, const glm::vec3& a,
                                                     const glm::vec3& b) {
    const std::optional<bool> there = reaches(scene, a, b);
    const std::optional<bool> back = reaches(scene, b, a);
    if (!there || !back) return std::nullopt;
    return std::array{*there, *back};
}

RelationCheck check_relations(const Scene& scene, const GroundTruth& truth, int threads) {
    RelationCheck check;
    for (const Relation& relation : relations()) {
        const std::optional<ChangedScene> changed = relation.change(scene);
        (changed ? check.tried : check.left_out).emplace_back(relation.name);
        if (changed) compare(check, relation.name, *changed, truth, threads);
    }
    check_exchange(check, scene);
    return check;
}

std::string words_of(const RelationCheck& check) {
    const std::string in =
        fmt::format("in {} relations, at {} pixels", check.tried.size(), check.compared);
    if (check.changed == 0) return "the truth stays the same " + in;
    return fmt::format("the truth changes {}: {} times, first {}", in, check.changed, check.first);
}

} // namespace shadowproof
