#include "reference/view.h"

#include "reference/norms.h"
#include "reference/parallel.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// The determinant in double is off by at most 48 u m l^2, m the largest coordinate of a - O and l
/// that of an edge: the normal's components are off by 8 u l^2 (two products of edges rounded to
/// u), which weighs 3 m; the dot product adds 4 u times its 3 terms of m 2 l^2.
std::int8_t side_of(const glm::dvec3& origin, const Corners& t, const Predicates& predicates) {
    constexpr double u = 0x1p-53;
    const glm::dvec3 a = t.a - origin;
    const glm::dvec3 ab = t.b - t.a;
    const glm::dvec3 ac = t.c - t.a;
    const double det = glm::dot(a, glm::cross(ab, ac));
    const double l = std::max(largest(ab), largest(ac));
    const double bound = 50 * u * largest(a) * l * l + std::numeric_limits<double>::min();
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return static_cast<std::int8_t>(predicates.side(origin, t).sign);
}

/// Relative to the origin, scaled, and one float further out, which covers the rounding of the
/// difference (2^-53) and of the conversion (2^-25).
Entry relative(const Entry& entry, const glm::dvec3& origin, double scale) {
    Entry result = entry;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        constexpr float infinity = std::numeric_limits<float>::infinity();
        result.lower[i] =
            std::nextafter(static_cast<float>((entry.lower[i] - origin[axis]) * scale), -infinity);
        result.upper[i] =
            std::nextafter(static_cast<float>((entry.upper[i] - origin[axis]) * scale), infinity);
    }
    return result;
}

/// Squared distance from the origin to the entry's box.
float distance(const Entry& entry) {
    float sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const float d = std::max({entry.lower[i], -entry.upper[i], 0.0F});
        sum += d * d;
    }
    return sum;
}

void sort_children(std::vector<Entry>& entries) {
    for (const Entry& entry : entries) {
        if (entry.count == 0) continue;
        const auto first = entries.begin() + entry.first;
        std::stable_sort(first, first + entry.count,
                         [](const Entry& a, const Entry& b) { return distance(a) < distance(b); });
    }
}

} // namespace

OriginView view_from(const glm::dvec3& origin, const Scene& scene, const Hierarchy& hierarchy,
                     const Predicates& predicates, int threads) {
    OriginView view;
    view.scene = &scene;
    view.hierarchy = &hierarchy;
    view.origin = origin;
    double reach = 0;
    const Entry& root = hierarchy.entries.front();
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        reach = std::max({reach, std::abs(root.lower[i] - origin[axis]),
                          std::abs(root.upper[i] - origin[axis])});
    }
    view.scale = reach > 0 ? std::exp2(-std::ilogb(reach) - 1) : 1;
    view.entries.reserve(hierarchy.entries.size());
    for (const Entry& entry : hierarchy.entries)
        view.entries.push_back(relative(entry, origin, view.scale));
    // The children of an entry stand behind it, so each group is sorted before it is looked into.
    sort_children(view.entries);

    constexpr int piece_size = 4096;
    const auto count = static_cast<int>(scene.triangles.size());
    view.side.resize(scene.triangles.size());
    parallel_for((count + piece_size - 1) / piece_size, threads, [&](int piece, int) {
        const int end = std::min(count, (piece + 1) * piece_size);
        for (int i = piece * piece_size; i < end; ++i) {
            const auto triangle = static_cast<std::uint32_t>(i);
            view.side[triangle] = side_of(origin, corners(scene, triangle), predicates);
        }
    });
    return view;
}

} // namespace shadowproof
