#include "reference/trace/seen_planes.h"

#include "reference/trace/plane_edges.h"
#include "reference/trace/view.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/seen_planes.cpp"
// The order matters.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "reference/walk/double_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

constexpr double u = double_roundoff;

/// t = numerator / denominator with running bounds; the bounds of both as in view.cpp.
void measure(const Vectors& directions, PlaneLanes& planes) {
    for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles)) {
        const Number x = load(directions.axis[0], i);
        const Number y = load(directions.axis[1], i);
        const Number z = load(directions.axis[2], i);
        const Number denominator = hn::Add(hn::Add(hn::Mul(x, load(planes.normal.axis[0], i)),
                                                   hn::Mul(y, load(planes.normal.axis[1], i))),
                                           hn::Mul(z, load(planes.normal.axis[2], i)));
        // The normal's error, and 3 roundings of 3 terms.
        const Number size = hn::Max(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
        const Number denominator_error =
            hn::Mul(size, hn::Add(hn::Mul(number(3.1), load(planes.normal_error, i)),
                                  hn::Mul(number(9.1 * u), load(planes.normal_size, i))));
        const Number reciprocal = hn::Div(number(1), denominator);
        const Number depth = hn::Mul(load(planes.numerator, i), reciprocal);
        const Number relative = hn::Add(hn::Add(load(planes.numerator_error, i),
                                                hn::Mul(denominator_error, hn::Abs(reciprocal))),
                                        number(2 * u));
        // First order; doubled for the rest as long as it is small. Otherwise there is no bound.
        const Number error = hn::IfThenElse(hn::Lt(relative, number(0.125)),
                                            hn::Mul(hn::Abs(depth), hn::Mul(number(2), relative)),
                                            number(std::numeric_limits<double>::infinity()));
        store(depth, planes.depth, i);
        store(error, planes.depth_error, i);
    }
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {

HWY_EXPORT(measure);

/// A power of two. Enough for the triangles of some tiles, and small enough for the first cache.
constexpr std::size_t plane_count = 64;

} // namespace

SeenPlanes::SeenPlanes(const Scene& scene) : scene_(&scene), planes_(plane_count) {
    for (std::size_t lane = 0; lane < packet_size; ++lane) forward_.set(lane, scene.camera.forward);
}

void SeenPlanes::Plane::start_from(const glm::dvec3& start) {
    const glm::dvec3 to_plane = corner - start;
    numerator = glm::dot(to_plane, normal);
    numerator_error = 50 * double_roundoff * largest(to_plane) * edges / std::abs(numerator);
}

SeenPlanes::Plane& SeenPlanes::plane_of(std::uint32_t triangle) {
    Plane& plane = planes_[triangle % plane_count];
    if (plane.triangle == triangle) return plane;
    const PlaneEdges edges(corners(*scene_, triangle));
    plane.triangle = triangle;
    plane.normal = glm::cross(edges.ab, edges.ac);
    plane.normal_error = 8.1 * double_roundoff * edges.product;
    plane.normal_size = largest(plane.normal);
    plane.corner = edges.a;
    plane.edges = edges.product;
    plane.start_from(scene_->camera.eye);
    return plane;
}

void SeenPlanes::measure(const Vectors& lines, std::uint32_t lanes,
                         const Lanes<std::uint32_t>& triangles, Lanes<double>& depth,
                         Lanes<double>& depth_error) {
    const bool is_parallel = scene_->camera.is_orthographic();
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
        const auto l = static_cast<std::size_t>(__builtin_ctz(left));
        Plane& plane = plane_of(triangles[l]);
        if (is_parallel) plane.start_from(lines[l]);
        lanes_.normal.set(l, plane.normal);
        lanes_.normal_error[l] = plane.normal_error;
        lanes_.normal_size[l] = plane.normal_size;
        lanes_.numerator[l] = plane.numerator;
        lanes_.numerator_error[l] = plane.numerator_error;
    }
    HWY_DYNAMIC_DISPATCH(measure)(is_parallel ? forward_ : lines, lanes_);
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
        const auto l = static_cast<std::size_t>(__builtin_ctz(left));
        depth[l] = lanes_.depth[l];
        depth_error[l] = lanes_.depth_error[l];
    }
}

} // namespace shadowproof
#endif
