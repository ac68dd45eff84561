#include "scenes/scaling.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

/// Whether a number times 2^power is exact and not a denormal.
template <class Float>
bool scales_exactly(Float number, int power) {
    if (number == 0) return true;
    const Float scaled = std::ldexp(number, power);
    return std::isnormal(scaled) && std::ldexp(scaled, -power) == number;
}

template <class Vector>
bool scales_exactly_by_components(const Vector& v, int power) {
    return scales_exactly(v.x, power) && scales_exactly(v.y, power) && scales_exactly(v.z, power);
}

} // namespace

bool scales_exactly(const Scene& scene, int power) {
    const auto exactly = [&](const auto& v) { return scales_exactly_by_components(v, power); };
    const Camera& camera = scene.camera;
    const bool far = std::isinf(camera.far) || scales_exactly(camera.far, power);
    const bool height = !camera.is_orthographic() || scales_exactly(camera.half_height, power);
    return far && height && exactly(camera.eye) && scales_exactly(camera.near, power) &&
           std::all_of(scene.positions.begin(), scene.positions.end(), exactly) &&
           std::all_of(scene.lights.begin(), scene.lights.end(), [&](const Light& light) {
               return exactly(light.position) &&
                      (!scene.inverse_square || scales_exactly(light.intensity, 2 * power));
           });
}

void scale(Scene& scene, double factor) {
    for (glm::vec3& position : scene.positions) position = glm::dvec3(position) * factor;
    for (Material& material : scene.materials)
        if (material.height_in_space) material.bump_scale *= factor;
    scene.camera.eye *= factor;
    scene.camera.near *= factor;
    scene.camera.far *= factor;
    if (scene.camera.is_orthographic()) scene.camera.half_height *= factor;
    for (Light& light : scene.lights) {
        light.position *= factor;
        light.range *= factor;
        // The light received falls off with the square of the distance.
        if (scene.inverse_square) light.intensity *= factor * factor;
    }
    scene.unit /= factor;
}

} // namespace shadowproof
