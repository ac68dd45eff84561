#include "compare/stencil/figures/near_layers.h"

#include "scenes/driver.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// The light along right, up, forward, and w, relative to the eye.
glm::dvec4 viewed_light(const Scene& scene) {
    const Camera& camera = scene.camera;
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec3 from = glm::dvec3(light) - light.w * camera.eye;
    return {glm::dot(camera.right, from), glm::dot(camera.up, from), glm::dot(camera.forward, from),
            light.w};
}

/// The size of a sum's terms, with the coefficients of a relative point, and a constant.
double terms(const glm::dvec3& coefficients, double constant, const glm::dvec3& relative) {
    return glm::dot(glm::abs(coefficients), glm::abs(relative)) + std::abs(constant);
}

/// A point of the triangle, how far it lies on the light's side of the plane, and its shadow.
struct Projected {
    double on_side = 0;
    double on_side_error = 0;
    ViewCorner shadow;
};

// With view coordinates (x, y, z), a light (l, w) and the plane's depth n, the shadow of p is the
// point p (l.z - w n) - l (p.z - n), divided by l.z - w p.z: both negated where the light lies
// before the plane. As one matrix of floats each of the three sums rounds its entries (v), products
// (v) and sums (3 v); the point relative to the eye, or to the light where casters touch it, was
// rounded twice before. Relative to the light, p = l + q, the shadow is q (w n - l.z) + l q.z over
// w q.z, without constants, and q.z - (w n - l.z) beyond the plane. A layer that was cut in double
// is rounded once, and goes through a projection: 6 v of its size.
Projected projected(const Scene& scene, const glm::dvec3& point, const NearDrawing& drawn) {
    const Camera& camera = scene.camera;
    const glm::dvec4 light = viewed_light(scene);
    const double n = camera.near;
    const double to_plane = light.w * n - light.z;
    const double sign = to_plane < 0 ? -1 : 1;
    const glm::dvec3 relative = point - camera.eye;
    const double beyond = glm::dot(camera.forward, relative) - n;
    const auto across = [&](const glm::dvec3& axis, double of_light) {
        return glm::dot(axis, relative) * std::abs(to_plane) + beyond * sign * of_light;
    };
    const bool from_light = drawn.casters_near_light;
    const glm::dvec3 from_origin = from_light ? point - chosen_light(scene).position : relative;
    const auto across_terms = [&](const glm::dvec3& axis, double of_light) {
        const double slope = sign * of_light;
        return terms(axis * std::abs(to_plane) + camera.forward * slope, from_light ? 0 : n * slope,
                     from_origin);
    };
    const double w = sign * (light.w * (beyond + n) - light.z);
    Projected p;
    p.on_side = -sign * beyond;
    p.shadow.at = {across(camera.right, light.x), across(camera.up, light.y), n * w, w};
    if (drawn.near_plane == NearPlane::from_light) {
        p.shadow.error =
            7 * v *
            glm::dvec3(across_terms(camera.right, light.x), across_terms(camera.up, light.y),
                       n * terms(light.w * camera.forward, from_light ? 0 : light.z, from_origin));
        // In perspective, w is the plane's depth times this, as the last one has it.
        if (camera.is_orthographic())
            p.shadow.w_error =
                7 * v * terms(light.w * camera.forward, from_light ? 0 : light.z, from_origin);
        p.on_side_error = 7 * v * terms(camera.forward, from_light ? to_plane : n, from_origin);
    } else {
        p.shadow.error = glm::dvec3(6 * v * std::sqrt(3.0) * glm::length(glm::dvec3(p.shadow.at)));
        p.on_side_error = 5 * double_roundoff * terms(camera.forward, n, relative);
    }
    return p;
}

} // namespace

// A corner is cut where it is seen from the eye, and at infinity where it is seen from the light:
// as differences and products with an axis that round 5 times, of up to the sizes of both. Three of
// them make the volume that the light sees the triangle fill.
bool is_flat_from_light(const Scene& casters, std::uint32_t triangle) {
    const glm::dvec4 light = homogeneous(chosen_light(casters));
    std::array<glm::dvec3, 3> from_light;
    double terms = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 place = corner(casters, triangle, static_cast<int>(k));
        from_light[k] = light.w * place - glm::dvec3(light);
        terms *= glm::length(from_light[k]) + glm::length(place - casters.camera.eye);
    }
    // A directional light's rays are parallel: what they see of the triangle is its area.
    if (light.w == 0) {
        const glm::dvec3 a = corner(casters, triangle, 0);
        const glm::dvec3 normal =
            glm::cross(corner(casters, triangle, 1) - a, corner(casters, triangle, 2) - a);
        return std::abs(glm::dot(normal, glm::dvec3(light))) <= 3 * 5 * double_roundoff * terms;
    }
    const double volume = glm::dot(from_light[0], glm::cross(from_light[1], from_light[2]));
    return std::abs(volume) <= 3 * 5 * double_roundoff * terms;
}

// A shadow on the plane is a sum of terms as large as the products of a caster's place and the
// light's, with some 16 roundings in all, over the light's distance from the plane.
bool is_in_near_plane(const Scene& casters) {
    const Camera& camera = casters.camera;
    const glm::dvec4 light = viewed_light(casters);
    const double to_plane = std::abs(light.w * camera.near - light.z);
    double reach = 0;
    for (const glm::dvec3 position : casters.positions)
        reach = std::max(reach, glm::distance(position, camera.eye));
    const double terms = reach * (to_plane + glm::length(glm::dvec3(light)));
    const double pixel = 1 / pixels_of_length(camera, camera.near);
    return to_plane * pixel <= 256 * 16 * double_roundoff * terms;
}

std::vector<ViewCorner> near_layer(const Scene& casters, std::uint32_t triangle,
                                   const NearDrawing& drawn, PlaneCut cut) {
    const double sign = cut == PlaneCut::nominal ? 0 : (cut == PlaneCut::most ? 1 : -1);
    std::array<Projected, 3> corners;
    std::array<double, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = projected(casters, corner(casters, triangle, static_cast<int>(k)), drawn);
        sides[k] = corners[k].on_side + sign * corners[k].on_side_error;
    }
    std::vector<ViewCorner> layer;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const ViewCorner& from = corners[k].shadow;
        const ViewCorner& to = corners[next].shadow;
        if (sides[k] >= 0) layer.push_back(from);
        if ((sides[k] < 0) == (sides[next] < 0)) continue;
        const double t = sides[k] / (sides[k] - sides[next]);
        ViewCorner made;
        made.at = from.at + t * (to.at - from.at);
        // As in clipped_polygon.cpp.
        made.error = (1 - t) * from.error + t * to.error +
                     3 * v * glm::max(glm::abs(glm::dvec3(from.at)), glm::abs(glm::dvec3(to.at)));
        made.w_error = (1 - t) * from.w_error + t * to.w_error;
        if (casters.camera.is_orthographic()) made.w_error += 3 * v * std::max(from.at.w, to.at.w);
        made.made_by_clipping = true;
        layer.push_back(made);
    }
    return layer;
}

} // namespace shadowproof
