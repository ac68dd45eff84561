#include "scenes/stress/parameters.h"
#include "scenes/stress/place.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

Light& light_of(Scene& scene) {
    return scene.lights[scene.light];
}

/// Whether the light has a place, and something casts.
bool has_place_and_caster(const Scene& scene) {
    return chosen_light(scene).kind != Light::Kind::directional && main_caster(scene).has_value();
}

bool is_point_over_caster(const Scene& scene) {
    return chosen_light(scene).kind == Light::Kind::point && main_caster(scene).has_value();
}

const Mesh& caster_of(const Scene& scene) {
    return scene.meshes[*main_caster(scene)];
}

/// What the light is moved towards.
using Target = glm::dvec3 (*)(const Scene& scene, const Mesh& caster, const glm::dvec3& light);

template <Target target>
glm::dvec3 target_of(const Scene& scene) {
    return target(scene, caster_of(scene), chosen_light(scene).position);
}

/// In diagonals of the caster; 1 where the light is there already.
template <Target target>
double distance_to(const Scene& scene) {
    const double distance = glm::distance(target_of<target>(scene), chosen_light(scene).position);
    return distance > 0 ? distance / diagonal_of(scene, caster_of(scene)) : 1;
}

template <Target target>
void take_distance_to(Scene& scene, double value) {
    const glm::dvec3 to = target_of<target>(scene);
    const glm::dvec3 away = unit_or(light_of(scene).position - to, {0, 1, 0});
    light_of(scene).position = to + value * diagonal_of(scene, caster_of(scene)) * away;
}

/// The point lies on its triangle exactly: a quarter, a quarter and a half of floats' sums.
glm::dvec3 face_middle(const Scene& scene, std::uint32_t triangle) {
    return 0.25 * corner(scene, triangle, 0) + 0.25 * corner(scene, triangle, 1) +
           0.5 * corner(scene, triangle, 2);
}

glm::dvec3 nearest_face(const Scene& scene, const Mesh& caster, const glm::dvec3& light) {
    std::uint32_t best = caster.first_triangle;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < caster.triangle_count; ++i) {
        const std::uint32_t triangle = caster.first_triangle + i;
        const glm::dvec3 point =
            nearest_point(corner(scene, triangle, 0), corner(scene, triangle, 1),
                          corner(scene, triangle, 2), light);
        const double distance = glm::distance(point, light);
        if (!(distance < nearest)) continue;
        nearest = distance;
        best = triangle;
    }
    return face_middle(scene, best);
}

/// Farther and farther along its direction from the caster; at 0 it is a directional light.
void take_w(Scene& scene, double value) {
    Light& light = light_of(scene);
    const glm::dvec3 to = target_of<nearest_face>(scene);
    const glm::dvec3 away = light.position - to;
    if (value > 0) {
        light.position = to + away / value;
        return;
    }
    light.kind = Light::Kind::directional;
    light.direction = -unit_or(away, {0, 1, 0});
}

/// The light as seen from the main receiver: where that is, and the directions of its plane.
struct Receiver {
    glm::dvec3 point{0, 0, 0};
    glm::dvec3 normal{0, 1, 0}; ///< to the light's side, unit
    glm::dvec3 to_light{0, 1, 0};
    std::uint32_t triangle = 0;
};

Receiver receiver_of(const Scene& scene) {
    Receiver receiver{.triangle = *main_receiver(scene)};
    const std::uint32_t t = receiver.triangle;
    receiver.point = face_middle(scene, t);
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    receiver.to_light = glm::dvec3(light) - light.w * receiver.point;
    const glm::dvec3 normal = glm::cross(corner(scene, t, 1) - corner(scene, t, 0),
                                         corner(scene, t, 2) - corner(scene, t, 0));
    receiver.normal =
        unit_or(glm::dot(normal, receiver.to_light) < 0 ? -normal : normal, receiver.normal);
    return receiver;
}

bool has_receiver(const Scene& scene) {
    return main_receiver(scene).has_value();
}

double elevation(const Scene& scene) {
    const Receiver receiver = receiver_of(scene);
    const glm::dvec3 toward = unit_or(receiver.to_light, receiver.normal);
    return std::max(1e-6, std::asin(std::clamp(glm::dot(toward, receiver.normal), 0.0, 1.0)));
}

/// The light goes round the receiver, as far away as it is. At 0 it goes along an edge, times a
/// power of two: exactly in the plane where the coordinates are short.
void take_elevation(Scene& scene, double radians) {
    const Receiver receiver = receiver_of(scene);
    const double distance = glm::length(receiver.to_light);
    const glm::dvec3 edge =
        corner(scene, receiver.triangle, 1) - corner(scene, receiver.triangle, 0);
    const glm::dvec3 level =
        unit_or(receiver.to_light - glm::dot(receiver.to_light, receiver.normal) * receiver.normal,
                unit_or(edge, {1, 0, 0}));
    glm::dvec3 to_light =
        distance * (std::cos(radians) * level + std::sin(radians) * receiver.normal);
    if (radians == 0)
        to_light = std::exp2(std::round(std::log2(distance / glm::length(edge)))) * edge;
    Light& light = light_of(scene);
    if (light.kind == Light::Kind::directional) {
        light.direction = -unit_or(to_light, receiver.normal);
        return;
    }
    light.position = receiver.point + to_light;
    if (light.kind == Light::Kind::spot) light.direction = -unit_or(to_light, receiver.normal);
}

bool has_place_over_receiver(const Scene& scene) {
    return chosen_light(scene).kind != Light::Kind::directional && has_receiver(scene);
}

double distance_to_plane(const Scene& scene) {
    const Receiver receiver = receiver_of(scene);
    return glm::dot(receiver.to_light, receiver.normal) / size_of(scene);
}

/// The light comes straight down to the receiver's plane.
void take_distance_to_plane(Scene& scene, double value) {
    const Receiver receiver = receiver_of(scene);
    const double height = glm::dot(receiver.to_light, receiver.normal);
    light_of(scene).position += (value * size_of(scene) - height) * receiver.normal;
}

} // namespace

std::vector<StressParameter> light_parameters() {
    return {
        {.name = "light_to_face",
         .words = "from a face of the main caster to the light, in diagonals of the caster",
         .low = 1e-16,
         .high = 1e7,
         .down_to_zero = true,
         .suits = has_place_and_caster,
         .own = distance_to<nearest_face>,
         .take = take_distance_to<nearest_face>},
        {.name = "light_to_edge",
         .words = "from the middle of an edge of the main caster to the light, in its diagonals",
         .low = 1e-16,
         .down_to_zero = true,
         .suits = has_place_and_caster,
         .own = distance_to<nearest_edge_middle>,
         .take = take_distance_to<nearest_edge_middle>},
        {.name = "light_to_vertex",
         .words = "from a vertex of the main caster to the light, in diagonals of the caster",
         .low = 1e-16,
         .down_to_zero = true,
         .suits = has_place_and_caster,
         .own = distance_to<nearest_vertex>,
         .take = take_distance_to<nearest_vertex>},
        {.name = "light_to_plane",
         .words = "from the plane of the main receiver to the light, in sizes of the scene",
         .low = 1e-16,
         .down_to_zero = true,
         .suits = has_place_over_receiver,
         .own = distance_to_plane,
         .take = take_distance_to_plane},
        {.name = "light_w",
         .words = "the light's own distance from the main caster over its distance; 0: directional",
         .low = 1e-12,
         .down_to_zero = true,
         .suits = is_point_over_caster,
         .own = [](const Scene&) { return 1.0; },
         .take = take_w},
        {.name = "light_elevation",
         .words = "of the light over the plane of the main receiver, in radians",
         .low = 1e-6,
         .down_to_zero = true,
         .suits = has_receiver,
         .own = elevation,
         .take = take_elevation},
    };
}

} // namespace shadowproof
