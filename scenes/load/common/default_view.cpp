#include "scenes/load/common/default_view.h"

#include "scenes/error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace shadowproof {

namespace {

struct Sphere {
    glm::dvec3 centre{0, 0, 0};
    double radius = 0;
};

/// Around the bounding box's centre; the radius reaches the furthest vertex.
Sphere bounding_sphere(const Scene& scene) {
    glm::dvec3 low = scene.positions.front();
    glm::dvec3 high = low;
    for (const glm::dvec3 position : scene.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    Sphere sphere{low * 0.5 + high * 0.5, 0};
    for (const glm::dvec3 position : scene.positions)
        sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, position));
    if (!(sphere.radius > 0))
        throw Error(scene.file.string(), "all vertices lie at one point, so nothing can be framed",
                    "add a camera and a light");
    return sphere;
}

} // namespace

bool orient(Camera& camera, const glm::dvec3& forward, const glm::dvec3& up) {
    camera.forward = glm::normalize(forward);
    camera.right = glm::normalize(glm::cross(camera.forward, glm::normalize(up)));
    camera.up = glm::cross(camera.right, camera.forward);
    return std::isfinite(glm::dot(camera.up, camera.up));
}

Camera default_camera(const SceneRequest& request, Scene& scene) {
    scene.notes.push_back("no camera in the file: default framing from the front, right and "
                          "above, 45 degrees, no far plane");
    const Sphere sphere = bounding_sphere(scene);
    const glm::dvec3 toward_eye = glm::normalize(glm::dvec3(0.5, 0.4, 1));
    Camera camera;
    camera.width = request.width;
    camera.height = request.height;
    camera.tan_half_height = std::tan(std::numbers::pi / 8);
    const glm::dvec2 half = half_extent(camera);
    const double distance = sphere.radius / std::sin(std::atan(std::min(half.x, half.y)));
    camera.eye = sphere.centre + distance * toward_eye;
    camera.near = (distance - sphere.radius) / 2;
    orient(camera, -toward_eye, {0, 1, 0});
    return camera;
}

void add_default_light(Scene& scene) {
    scene.notes.push_back("no light in the file: a point light above and to the left of the "
                          "camera");
    const Sphere sphere = bounding_sphere(scene);
    const glm::dvec3 toward_light =
        glm::normalize(scene.camera.up - 0.5 * scene.camera.right - 0.6 * scene.camera.forward);
    Light light;
    light.name = "default";
    light.position = sphere.centre + 3 * sphere.radius * toward_light;
    scene.lights.push_back(light);
}

} // namespace shadowproof
