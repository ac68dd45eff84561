#include "scenes/error.h"
#include "scenes/mesh/half_edge.h"
#include "scenes/mesh/topology.h"
#include "scenes/plan/plan.h"
#include "scenes/stress/parameters.h"
#include "scenes/stress/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace shadowproof {

namespace {

constexpr double radians = std::numbers::pi / 180;

/// A point in the middle of the picture, as far away as the scene is large.
glm::dvec3 aim_of(const Scene& scene) {
    return scene.camera.eye + size_of(scene) * scene.camera.forward;
}

/// Turns the camera towards a point, and leaves it where that has no direction.
void look_at(Camera& camera, const glm::dvec3& target) {
    camera.forward = unit_or(target - camera.eye, camera.forward);
    camera.right = unit_or(glm::cross(camera.forward, camera.up), camera.right);
    camera.up = glm::cross(camera.right, camera.forward);
}

void require_planes(const Camera& camera) {
    if (!(camera.near < camera.far))
        throw Error("the camera",
                    fmt::format("would have its near plane at {} and its far plane at {}",
                                camera.near, camera.far),
                    "take a nearer near plane");
}

/// An orthographic camera's may be where it stands.
bool has_near_plane(const Scene& scene) {
    return scene.camera.near > 0;
}

void take_near_plane(Scene& scene, double value) {
    scene.camera.near = value * size_of(scene);
    require_planes(scene.camera);
}

void take_near_over_far(Scene& scene, double value) {
    scene.camera.far =
        value > 0 ? scene.camera.near / value : std::numeric_limits<double>::infinity();
    require_planes(scene.camera);
}

bool is_perspective(const Scene& scene) {
    return !scene.camera.is_orthographic();
}

double field_of_view(const Scene& scene) {
    return 2 * std::atan(scene.camera.half_height) / radians;
}

void take_field_of_view(Scene& scene, double degrees) {
    scene.camera.half_height = std::tan(0.5 * degrees * radians);
}

double aspect(const Scene& scene) {
    return static_cast<double>(scene.camera.width) / scene.camera.height;
}

/// As many pixels, as nearly as whole sides allow.
void take_aspect(Scene& scene, double value) {
    Camera& camera = scene.camera;
    const double pixels = static_cast<double>(camera.width) * camera.height;
    camera.width = std::max(1, static_cast<int>(std::lround(std::sqrt(pixels * value))));
    camera.height = std::max(1, static_cast<int>(std::lround(pixels / camera.width)));
    if (std::max(camera.width, camera.height) > largest_side)
        throw Error("the picture",
                    fmt::format("would be {}x{} pixels, more than {} a side", camera.width,
                                camera.height, largest_side),
                    "take a smaller --size");
}

void take_eye_distance(Scene& scene, double value) {
    const glm::dvec3 aim = aim_of(scene);
    scene.camera.eye = aim - value * size_of(scene) * scene.camera.forward;
}

/// A side of the main caster's shadow volume, by the edge that is nearest to the eye.
struct Side {
    glm::dvec3 a{0, 0, 0};
    glm::dvec3 b{0, 0, 0};
};

/// None where the main caster has no edge between a face that the light sees and one that it does
/// not.
std::optional<Side> nearest_side(const Scene& scene) {
    const std::optional<std::uint32_t> caster = main_caster(scene);
    if (!caster) return std::nullopt;
    const HalfEdgeMesh mesh =
        connect(scene, weld_by_position(scene.positions), triangles_of(scene.meshes[*caster]));
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const auto is_lit = [&](std::uint32_t half_edge) {
        return side(scene, mesh.half_edges[half_edge].triangle, light) > 0;
    };
    std::optional<Side> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Edge& edge : mesh.edges) {
        const HalfEdge& half = mesh.half_edges[edge.half_edge];
        if (edge.twin != no_half_edge && is_lit(edge.half_edge) == is_lit(edge.twin)) continue;
        const Side candidate{scene.positions[half.origin],
                             scene.positions[mesh.half_edges[half.next].origin]};
        const double distance = glm::distance(0.5 * (candidate.a + candidate.b), scene.camera.eye);
        if (!(distance < nearest)) continue;
        nearest = distance;
        best = candidate;
    }
    return best;
}

bool has_side(const Scene& scene) {
    return is_perspective(scene) && nearest_side(scene).has_value();
}

/// The eye goes behind the middle of the edge, as seen from the light, about as far as it is from
/// it now, and looks where it looked before. The factor is a power of two, so that the place is on
/// the side exactly where the coordinates are short.
void take_eye_to_side(Scene& scene, double value) {
    const std::optional<Side> found = nearest_side(scene);
    const glm::dvec3 middle = 0.5 * (found->a + found->b);
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec3 away = light.w * middle - glm::dvec3(light);
    const glm::dvec3 normal = unit_or(glm::cross(found->b - found->a, away), {0, 1, 0});
    const double factor = glm::distance(scene.camera.eye, middle) / glm::length(away);
    const glm::dvec3 on_side = middle + std::exp2(std::round(std::log2(factor))) * away;
    const double toward_eye = glm::dot(scene.camera.eye - on_side, normal) < 0 ? -1 : 1;
    const glm::dvec3 aim = aim_of(scene);
    const double size = size_of(scene);
    scene.camera.eye = on_side + value * size * toward_eye * normal;
    look_at(scene.camera, aim);
}

} // namespace

std::vector<StressParameter> view_parameters() {
    return {
        {.name = "near_plane",
         .words = "the near plane's depth, in sizes of the scene",
         .low = 1e-7,
         .high = 1,
         .suits = has_near_plane,
         .own = [](const Scene& scene) { return scene.camera.near / size_of(scene); },
         .take = take_near_plane},
        {.name = "near_over_far",
         .words = "the near plane's depth over the far plane's; 0: no far plane",
         .low = 1e-12,
         .down_to_zero = true,
         .suits = has_near_plane,
         .own = [](const Scene& scene) { return scene.camera.near / finite_far(scene); },
         .take = take_near_over_far},
        {.name = "field_of_view",
         .words = "from the picture's top to its bottom, in degrees",
         .low = 0.01,
         .high = 179,
         .suits = is_perspective,
         .own = field_of_view,
         .take = take_field_of_view},
        {.name = "aspect",
         .words = "the picture's width over its height, of as many pixels",
         .low = 0.016,
         .high = 64,
         .suits = any_scene,
         .own = aspect,
         .take = take_aspect},
        {.name = "eye_distance",
         .words = "from the middle of what the eye sees, in its own distances",
         .low = 1e-4,
         .high = 1e4,
         .suits = is_perspective,
         .own = [](const Scene&) { return 1.0; },
         .take = take_eye_distance},
        {.name = "eye_to_side",
         .words = "from a side of the main caster's volume to the eye, in sizes of the scene",
         .low = 1e-16,
         .down_to_zero = true,
         .suits = has_side,
         .own = [](const Scene&) { return 1.0; },
         .take = take_eye_to_side},
    };
}

} // namespace shadowproof
