#include "scenes/relations/relation_table.h"
#include "scenes/scaling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shadowproof {

namespace {

ChangedScene same_triangles(const Scene& scene) {
    ChangedScene changed{.scene = scene,
                         .original = std::vector<std::uint32_t>(scene.triangles.size())};
    std::iota(changed.original.begin(), changed.original.end(), 0U);
    return changed;
}

/// Whether a sum of doubles is exact.
bool adds_exactly(double a, double b) {
    const double sum = a + b;
    return sum - a == b && sum - b == a;
}

bool adds_exactly(float a, double b) {
    const double sum = double{a} + b;
    return adds_exactly(double{a}, b) && double{static_cast<float>(sum)} == sum;
}

/// The largest power of two, with its sign, by which all can be moved along an axis; 0 where there
/// is none above the last bits of what is there.
double exact_offset(const Scene& scene, int axis) {
    double largest = std::abs(scene.camera.eye[axis]);
    for (const glm::vec3& position : scene.positions)
        largest = std::max(largest, std::abs(double{position[axis]}));
    if (largest == 0) largest = 1;
    const auto moves_all = [&](double offset) {
        return adds_exactly(scene.camera.eye[axis], offset) &&
               std::ranges::all_of(scene.lights,
                                   [&](const Light& light) {
                                       return adds_exactly(light.position[axis], offset);
                                   }) &&
               std::ranges::all_of(scene.positions, [&](const glm::vec3& position) {
                   return adds_exactly(position[axis], offset);
               });
    };
    // Floats of 24 bits: beyond 2^23 times itself no vertex but the origin can be moved.
    for (int power = std::ilogb(largest) + 23; power >= std::ilogb(largest) - 23; --power)
        for (const double sign : {-1.0, 1.0})
            if (moves_all(std::ldexp(sign, power))) return std::ldexp(sign, power);
    return 0;
}

std::optional<ChangedScene> move(const Scene& scene) {
    glm::dvec3 offset(0, 0, 0);
    for (int axis = 0; axis < 3; ++axis) offset[axis] = exact_offset(scene, axis);
    if (offset == glm::dvec3(0, 0, 0)) return std::nullopt;
    ChangedScene changed = same_triangles(scene);
    for (glm::vec3& position : changed.scene.positions)
        position = glm::vec3(glm::dvec3(position) + offset);
    changed.scene.camera.eye += offset;
    for (Light& light : changed.scene.lights) light.position += offset;
    return changed;
}

std::optional<ChangedScene> scale_by_power(const Scene& scene) {
    // Up or down, so far that a length which some code takes for a length of 1 shows.
    for (const int power : {10, -10, 3, -3}) {
        if (!scales_exactly(scene, power)) continue;
        ChangedScene changed = same_triangles(scene);
        scale(changed.scene, std::ldexp(1.0, power));
        return changed;
    }
    return std::nullopt;
}

/// Applies a map of vectors, which only exchanges and negates components, to all that has a place
/// or a direction.
template <class Map>
ChangedScene mapped(const Scene& scene, const Map& map) {
    ChangedScene changed = same_triangles(scene);
    Scene& result = changed.scene;
    for (glm::vec3& position : result.positions) position = map(position);
    for (Surface& surface : result.surfaces) {
        surface.normal = map(surface.normal);
        surface.tangent = glm::vec4(map(glm::vec3(surface.tangent)), surface.tangent.w);
    }
    Camera& camera = result.camera;
    for (glm::dvec3* vector : {&camera.eye, &camera.right, &camera.up, &camera.forward})
        *vector = map(*vector);
    for (Light& light : result.lights) {
        light.position = map(light.position);
        light.direction = map(light.direction);
    }
    // Its texels would have to be turned too; what they change is no visibility.
    result.environment.reset();
    return changed;
}

/// By 90 degrees about an axis.
template <int axis>
std::optional<ChangedScene> turn(const Scene& scene) {
    return mapped(scene, [](auto v) {
        constexpr int u = (axis + 1) % 3;
        constexpr int w = (axis + 2) % 3;
        const auto along_u = v[u];
        v[u] = -v[w];
        v[w] = along_u;
        return v;
    });
}

/// Across the plane x = 0, the camera with all else: its right and up then are those of a mirror's
/// picture, and the pixels stay.
std::optional<ChangedScene> mirror(const Scene& scene) {
    ChangedScene changed = mapped(scene, [](auto v) {
        v.x = -v.x;
        return v;
    });
    for (glm::uvec3& triangle : changed.scene.triangles) std::swap(triangle.y, triangle.z);
    for (std::size_t i = 0; i + 2 < changed.scene.surfaces.size(); i += 3)
        std::swap(changed.scene.surfaces[i + 1], changed.scene.surfaces[i + 2]);
    for (Surface& surface : changed.scene.surfaces) surface.tangent.w = -surface.tangent.w;
    return changed;
}

} // namespace

std::vector<Relation> motions() {
    return {
        {.name = "moved", .words = "all is moved by powers of two", .change = move},
        {.name = "scaled", .words = "all lengths times a power of two", .change = scale_by_power},
        {.name = "turned_about_x", .words = "a quarter turn about x", .change = turn<0>},
        {.name = "turned_about_y", .words = "a quarter turn about y", .change = turn<1>},
        {.name = "turned_about_z", .words = "a quarter turn about z", .change = turn<2>},
        {.name = "mirrored",
         .words = "all is mirrored, the camera too",
         .change = mirror,
         .keeps_camera_right_handed = false},
    };
}

} // namespace shadowproof
