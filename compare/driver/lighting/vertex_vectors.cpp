#include "compare/driver/lighting/vertex_vectors.h"

#include "compare/driver/lighting/lighting_ranges.h"
#include "scenes/driver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace shadowproof {

namespace {

constexpr double v = float_roundoff;

/// A vector at a corner, and how far off floats may be.
struct CornerVector {
    glm::dvec3 value{0, 0, 0};
    double off = 0;
};

/// Over its length: three roundings of a square's products and sums, of which the root takes half,
/// the root's and the quotient's, so 4 v; and what it was off itself.
CornerVector normalised(const CornerVector& a) {
    const double length = glm::length(a.value);
    if (!(length > 0)) return {a.value, a.off > 0 ? 2.0 : 0.0};
    return {a.value / length, turned_by(a.off / length) + 4 * v};
}

/// A way from a place of floats to one of doubles, each component of which is rounded twice
/// (lit.vert): less the place as the nearest float, and less the rest of it, which is rounded once
/// more. `size`: of that place.
CornerVector difference(const glm::dvec3& value, double size) {
    return {value, 2 * v * glm::length(value) + std::sqrt(3.0) * two_floats_roundoff * size};
}

/// The frame's transpose, and how far its worst axis may be off.
struct CornerFrame {
    glm::dmat3 into{1};
    double off = 0;
};

/// Floats: N is normalised (4 v). T is t less N times their product, of vectors that are at most 1
/// long: t may be a polygon's, N stands there twice (8 v), the product has three roundings, its
/// product with N and the difference one each (5 v); that over the length of what is left, and
/// normalised (4 v). B is a cross product of both (3 v of a length of 1) and is off by what they
/// are.
CornerFrame frame_of(const Surface& corner) {
    const glm::dvec3 t(glm::vec3(corner.tangent));
    const glm::dvec3 n = glm::normalize(glm::dvec3(corner.normal));
    const glm::dvec3 across = t - n * glm::dot(n, t);
    const double length = glm::length(across);
    if (!(length > 0)) return {glm::transpose(glm::dmat3(glm::dvec3(0), glm::dvec3(0), n)), 2};
    const glm::dvec3 tangent = across / length;
    const double tangent_off = turned_by((13 * v + polygon_tangent_error) / length) + 4 * v;
    const glm::dmat3 frame(tangent, double{corner.tangent.w} * glm::cross(n, tangent), n);
    return {glm::transpose(frame), 4 * v + tangent_off + 3 * v};
}

/// Three components, each a product with an axis that is off, of three roundings: the root of 3 of
/// what one is off.
CornerVector carried(const CornerFrame& frame, const CornerVector& a) {
    return {frame.into * a.value,
            a.off + std::sqrt(3.0) * (frame.off + 3 * v) * (glm::length(a.value) + a.off)};
}

using Corners = std::array<CornerVector, 3>;

glm::dvec3 blend(const glm::dvec3& weights, const Corners& corners) {
    return weights.x * corners[0].value + weights.y * corners[1].value +
           weights.z * corners[2].value;
}

/// What the corners are off comes through by their weights; what is interpolated is rounded by a
/// share of the largest (attribute_error).
VectorRange interpolated(const Corners& corners, const PixelSpread& spread) {
    const glm::dvec3 middle = blend(spread.middle, corners);
    const auto off_at = [&](const glm::dvec3& weights) {
        double off = glm::distance(blend(weights, corners), middle);
        for (int k = 0; k < 3; ++k)
            off += std::abs(weights[k]) * corners[static_cast<std::size_t>(k)].off;
        return off;
    };
    double off = off_at(spread.middle);
    if (spread.aside)
        for (const glm::dvec3& weights : spread.corners) off = std::max(off, off_at(weights));
    double largest = 0;
    for (const CornerVector& corner : corners)
        largest = std::max(largest, glm::length(corner.value) + corner.off);
    return {around(middle), off + spread.share * largest};
}

} // namespace

VertexVectors vertex_vectors(const Scene& scene, std::uint32_t triangle,
                             std::span<const Surface, 3> corners, VectorOrigin origin,
                             const PixelSpread& spread) {
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    const glm::dvec3& eye = scene.camera.eye;
    const bool is_bumpy = material_of(scene, triangle).bump != Bump::none;
    Corners lights;
    Corners halves;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const glm::dvec3 place = corner(scene, triangle, k) - eye;
        CornerVector to_light = difference((glm::dvec3(light) - light.w * eye) - light.w * place,
                                           glm::length(glm::dvec3(light)));
        const CornerVector l = normalised(to_light);
        const CornerVector e =
            normalised(scene.camera.is_orthographic() ? difference(-scene.camera.forward, 1)
                                                      : difference(-place, glm::length(eye)));
        CornerVector half{l.value + e.value, l.off + e.off + 2 * v};
        if (origin == VectorOrigin::unit_at_vertices) {
            to_light = l;
            half = normalised(half);
        }
        const CornerFrame frame = is_bumpy ? frame_of(corners[i]) : CornerFrame{};
        lights[i] = carried(frame, to_light);
        halves[i] = carried(frame, half);
    }
    return {interpolated(lights, spread), interpolated(halves, spread)};
}

} // namespace shadowproof
