#include "scenes/load/common/default_view.h"

#include "scenes/load/common/bounding_sphere.h"
#include "scenes/load/common/room.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

namespace shadowproof {

namespace {

/// In a room: half way from its middle to what is above it.
glm::dvec3 place_within(const Scene& scene) {
    const glm::dvec3 middle = bounding_sphere(scene).centre;
    const std::optional<FirstHit> above = first_hit(scene, middle, {0, 1, 0});
    return middle + glm::dvec3(0, above ? above->distance / 2 : 0, 0);
}

/// Horizontal and unit; along x where v is upright.
glm::dvec3 levelled(const glm::dvec3& v) {
    const glm::dvec3 level(v.x, 0, v.z);
    const double length = glm::length(level);
    return length > 0 && std::isfinite(length) ? level / length : glm::dvec3(1, 0, 0);
}

/// Above, to the left of the camera and a little towards it: the shadow falls to the right, where
/// the model does not hide it.
glm::dvec3 place_outside(const Scene& scene) {
    const Sphere sphere = bounding_sphere(scene);
    const glm::dvec3 toward_light =
        glm::normalize(glm::dvec3(0, 1, 0) - 0.7 * levelled(scene.camera.right) -
                       0.25 * levelled(scene.camera.forward));
    return sphere.centre + 3 * sphere.radius * toward_light;
}

} // namespace

bool orient(Camera& camera, const glm::dvec3& forward, const glm::dvec3& up) {
    camera.forward = glm::normalize(forward);
    camera.right = glm::normalize(glm::cross(camera.forward, glm::normalize(up)));
    camera.up = glm::cross(camera.right, camera.forward);
    return std::isfinite(glm::dot(camera.up, camera.up));
}

Camera default_camera(const SceneRequest& request, Scene& scene) {
    scene.default_framing = true;
    scene.notes.push_back("no camera in the file: default framing from the front, right and "
                          "above, 45 degrees, no far plane");
    const Sphere sphere = bounding_sphere(scene);
    const glm::dvec3 toward_eye = glm::normalize(glm::dvec3(0.5, 0.4, 1));
    Camera camera;
    camera.width = request.width;
    camera.height = request.height;
    camera.half_height = std::tan(std::numbers::pi / 8);
    const glm::dvec2 half = half_extent(camera);
    const double distance = sphere.radius / std::sin(std::atan(std::min(half.x, half.y)));
    camera.eye = sphere.centre + distance * toward_eye;
    camera.near = (distance - sphere.radius) / 2;
    orient(camera, -toward_eye, {0, 1, 0});
    return camera;
}

void add_default_light(Scene& scene) {
    scene.default_framing = true;
    const bool within = is_room(scene);
    scene.notes.push_back(
        within ? "no light in the file, whose surfaces look inwards: a point light in their middle"
               : "no light in the file: a point light above and to the left of the camera");
    Light light;
    light.name = "default";
    light.position = within ? place_within(scene) : place_outside(scene);
    scene.lights.push_back(light);
}

} // namespace shadowproof
