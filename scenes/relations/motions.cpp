#include "scenes/relations/retellings.h"
#include "scenes/scaling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shadowproof {

namespace {

RetoldScene same_triangles(const Scene& scene) {
    RetoldScene retold{.scene = scene,
                       .original = std::vector<std::uint32_t>(scene.triangles.size())};
    std::iota(retold.original.begin(), retold.original.end(), 0U);
    return retold;
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

std::optional<RetoldScene> move(const Scene& scene) {
    glm::dvec3 offset(0, 0, 0);
    for (int axis = 0; axis < 3; ++axis) offset[axis] = exact_offset(scene, axis);
    if (offset == glm::dvec3(0, 0, 0)) return std::nullopt;
    RetoldScene retold = same_triangles(scene);
    for (glm::vec3& position : retold.scene.positions)
        position = glm::vec3(glm::dvec3(position) + offset);
    retold.scene.camera.eye += offset;
    for (Light& light : retold.scene.lights) light.position += offset;
    return retold;
}

std::optional<RetoldScene> scale_by_power(const Scene& scene) {
    // Up or down, so far that a length which some code takes for a length of 1 shows.
    for (const int power : {10, -10, 3, -3}) {
        if (!scales_exactly(scene, power)) continue;
        RetoldScene retold = same_triangles(scene);
        scale(retold.scene, std::ldexp(1.0, power));
        return retold;
    }
    return std::nullopt;
}

/// Applies a map of vectors, which only exchanges and negates components, to all that has a place
/// or a direction.
template <class Map>
RetoldScene mapped(const Scene& scene, const Map& map) {
    RetoldScene retold = same_triangles(scene);
    Scene& result = retold.scene;
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
    return retold;
}

/// By 90 degrees about an axis.
template <int axis>
std::optional<RetoldScene> turn(const Scene& scene) {
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
std::optional<RetoldScene> mirror(const Scene& scene) {
    RetoldScene retold = mapped(scene, [](auto v) {
        v.x = -v.x;
        return v;
    });
    for (glm::uvec3& triangle : retold.scene.triangles) std::swap(triangle.y, triangle.z);
    for (std::size_t i = 0; i + 2 < retold.scene.surfaces.size(); i += 3)
        std::swap(retold.scene.surfaces[i + 1], retold.scene.surfaces[i + 2]);
    for (Surface& surface : retold.scene.surfaces) surface.tangent.w = -surface.tangent.w;
    return retold;
}

} // namespace

std::vector<Relation> motions() {
    return {
        {.name = "moved", .words = "all is moved by powers of two", .retell = move},
        {.name = "scaled", .words = "all lengths times a power of two", .retell = scale_by_power},
        {.name = "turned_about_x", .words = "a quarter turn about x", .retell = turn<0>},
        {.name = "turned_about_y", .words = "a quarter turn about y", .retell = turn<1>},
        {.name = "turned_about_z", .words = "a quarter turn about z", .retell = turn<2>},
        {.name = "mirrored",
         .words = "all is mirrored, the camera too",
         .retell = mirror,
         .keeps_camera_right_handed = false},
    };
}

} // namespace shadowproof
