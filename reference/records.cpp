#include "reference/records.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace shadowproof {

namespace {

/// Measured with tests/bench: half as many cost a twentieth more at 1M triangles, twice as many
/// leave the second-level cache.
constexpr std::size_t slot_count = 256;

constexpr double u = 0x1p-53; ///< rounding unit of double
constexpr double v = 0x1p-24; ///< rounding unit of float

double largest(const glm::dvec3& w) {
    return std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
}

double sum_of(const glm::dvec3& w) {
    return std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
}

std::array<float, 3> rounded(const glm::dvec3& w) {
    return {static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)};
}

/// The next float above.
float rounded_up(double x) {
    return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

// The bound of a float dot product w . N, N known in double to within e a component.
//   w: its float differs from the true direction by v |w_i| of rounding, and by at most v |w| / 2
//      of error in the surface point it leads to (Lane::magnitude, packet.h, sees to that);
//   N: its float by v |N_i| + e;
//   the products and two sums: 3 roundings.
// To first order |w| ((3 + 1 + 1.5) v |N|_1 + 3 e). 7 v covers second order, and that threshold and
// |w| are floats themselves. A float that underflows is off by less than 2^-126, which 2^-100
// covers, as 0.5 <= |w|.
float tolerance(const glm::dvec3& n, double component_error) {
    return rounded_up(7 * v * sum_of(n) + 3.1 * component_error + 0x1p-100);
}

TriangleRecord make_record(const OriginView& view, std::uint32_t triangle) {
    Corners t = corners(*view.scene, triangle);
    if (view.side[triangle] < 0) std::swap(t.b, t.c);
    const glm::dvec3 a = (t.a - view.origin) * view.scale;
    const glm::dvec3 b = (t.b - view.origin) * view.scale;
    const glm::dvec3 c = (t.c - view.origin) * view.scale;
    const glm::dvec3 ab = (t.b - t.a) * view.scale;
    const glm::dvec3 bc = (t.c - t.b) * view.scale;
    const glm::dvec3 ca = (t.a - t.c) * view.scale;
    const double m = std::max({largest(a), largest(b), largest(c)});
    const double l = std::max({largest(ab), largest(bc), largest(ca)});

    // Differences are off by u, so each component of a x (b - a), two products and a difference,
    // by 4 u (m l + m l).
    const std::array<glm::dvec3, 3> edges{glm::cross(a, ab), glm::cross(b, bc), glm::cross(c, ca)};
    const double edge_error = 8.1 * u * m * l;

    // As in view.cpp: the normal is off by 8 u l^2 a component, det by 48 u m l^2.
    const glm::dvec3 normal = glm::cross(ab, -ca);
    const double det = glm::dot(a, normal);
    const double det_error = 50 * u * m * l * l;

    TriangleRecord record;
    record.triangle = triangle;
    double edge_tolerance = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        record.edge[k] = rounded(edges[k]);
        edge_tolerance = std::max<double>(edge_tolerance, tolerance(edges[k], edge_error));
    }
    record.edge_tolerance = static_cast<float>(edge_tolerance);
    if (det > 4 * det_error) {
        // normal / det: the normal's error over det, and its own size times det's relative error,
        // at most 4/3 det_error / det since det may be that much smaller.
        const glm::dvec3 inverse = normal / det;
        const double inverse_error =
            (8.2 * u * l * l + 1.4 * largest(inverse) * det_error) / det + u * largest(inverse);
        record.inverse = rounded(inverse);
        record.inverse_tolerance = tolerance(inverse, inverse_error);
    } else {
        record.inverse_tolerance = std::numeric_limits<float>::infinity();
    }
    return record;
}

} // namespace

RecordCache::RecordCache(const OriginView& view, Part part,
                         const std::vector<std::uint8_t>& double_sided)
    : view_(&view), part_(part), double_sided_(&double_sided), slots_(slot_count) {}

bool RecordCache::takes_part(std::uint32_t triangle) const {
    const std::int8_t side = view_->side[triangle];
    switch (part_) {
    case Part::seen:
        return side < 0 || (side > 0 && (*double_sided_)[triangle] != 0);
    case Part::occluding:
        return side != 0;
    case Part::light_facing:
        break;
    }
    return side < 0;
}

void RecordCache::fill(Slot& slot, std::uint32_t cluster) const {
    slot.cluster = cluster;
    slot.record.count = 0;
    const Cluster& members = view_->hierarchy->clusters[cluster];
    for (std::uint32_t i = 0; i < members.count; ++i) {
        const std::uint32_t triangle = members.triangles[i];
        if (takes_part(triangle))
            slot.record.triangles[slot.record.count++] = make_record(*view_, triangle);
    }
}

} // namespace shadowproof
