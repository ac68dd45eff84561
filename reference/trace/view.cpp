#include "reference/trace/view.h"

#include "reference/exact/norms.h"
#include "reference/parallel.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

/// The determinant in double is off by at most 48 u m l^2, m the largest coordinate of a - O (or of
/// the direction) and l that of an edge: the normal's components are off by 8 u l^2 (two products
/// of edges rounded to u), which weighs 3 m; the dot product adds 4 u times its 3 terms of m 2 l^2.
std::int8_t side_of(const glm::dvec4& from, const Corners& t, const Predicates& predicates) {
    constexpr double u = double_roundoff;
    const glm::dvec3 a = from.w * t.a - glm::dvec3(from);
    const glm::dvec3 ab = t.b - t.a;
    const glm::dvec3 ac = t.c - t.a;
    const double det = glm::dot(a, glm::cross(ab, ac));
    const double l = std::max(largest(ab), largest(ac));
    const double bound = 50 * u * largest(a) * l * l + std::numeric_limits<double>::min();
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return static_cast<std::int8_t>(predicates.side(from, t).sign);
}

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A box that reaches beyond 1 is made infinite: what packet.cpp shows for rays and boxes holds
/// within 1, and what lies beyond is decided without floats (records.cpp).
void open_where_outlying(Entry& entry) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (entry.lower[i] >= -1 && entry.upper[i] <= 1) continue;
        entry.lower.fill(-infinity);
        entry.upper.fill(infinity);
        return;
    }
}

/// Relative to the origin, scaled, and one float further out, which covers the rounding of the
/// difference (2^-53) and of the conversion (2^-25).
Entry relative(const Entry& entry, const glm::dvec3& origin, double scale) {
    Entry result = entry;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        result.lower[i] =
            std::nextafter(static_cast<float>((entry.lower[i] - origin[axis]) * scale), -infinity);
        result.upper[i] =
            std::nextafter(static_cast<float>((entry.upper[i] - origin[axis]) * scale), infinity);
    }
    open_where_outlying(result);
    return result;
}

/// Squared distance from the origin to the entry's box; for parallel rays, where the box begins.
float distance(const Entry& entry, bool parallel) {
    if (parallel) return -entry.upper[2];
    float sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const float d = std::max({entry.lower[i], -entry.upper[i], 0.0F});
        sum += d * d;
    }
    return sum;
}

void sort_children(std::vector<Entry>& entries, bool parallel) {
    for (const Entry& entry : entries) {
        if (entry.count == 0) continue;
        const auto first = entries.begin() + entry.first;
        std::stable_sort(first, first + entry.count, [&](const Entry& a, const Entry& b) {
            return distance(a, parallel) < distance(b, parallel);
        });
    }
}

/// The same for parallel rays, from the corners themselves: a box around a sheared box would be
/// several times as large. What the doubles round, meets_ground's pad covers (packet.cpp).
Entry sheared(const Entry& entry, const Cluster& cluster, const OriginView& view) {
    Entry result = entry;
    result.lower.fill(infinity);
    result.upper.fill(-infinity);
    for (std::uint32_t i = 0; i < cluster.count; ++i)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 world = corner(*view.scene, cluster.triangles[i], k);
            const glm::dvec3 relative = (world - view.origin) * view.scale;
            // So far out, a place beyond the light might be mapped back into the scene.
            const glm::vec3 p =
                largest(relative) > 0.5 ? glm::vec3(infinity) : glm::vec3(view.shear(relative));
            for (int axis = 0; axis < 3; ++axis) {
                float& lower = result.lower[static_cast<std::size_t>(axis)];
                float& upper = result.upper[static_cast<std::size_t>(axis)];
                lower = std::min(lower, std::nextafter(p[axis], -infinity));
                upper = std::max(upper, std::nextafter(p[axis], infinity));
            }
        }
    open_where_outlying(result);
    return result;
}

/// Shears the entries from the leaves up: the children of an entry come after it.
void shear_entries(const Hierarchy& hierarchy, OriginView& view) {
    view.entries = hierarchy.entries;
    for (std::size_t i = view.entries.size(); i-- > 0;) {
        Entry& entry = view.entries[i];
        if (entry.count == 0) {
            entry = sheared(entry, hierarchy.clusters[entry.first], view);
            continue;
        }
        const Entry& child = view.entries[entry.first];
        entry.lower = child.lower;
        entry.upper = child.upper;
        for (std::uint32_t k = 1; k < entry.count; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Entry& other = view.entries[entry.first + k];
                entry.lower[axis] = std::min(entry.lower[axis], other.lower[axis]);
                entry.upper[axis] = std::max(entry.upper[axis], other.upper[axis]);
            }
    }
}

/// The largest component's distance of any corner of an entry's box from `origin`.
double reach_of(const Entry& entry, const glm::dvec3& origin) {
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        reach = std::max({reach, std::abs(entry.lower[i] - origin[axis]),
                          std::abs(entry.upper[i] - origin[axis])});
    }
    return reach;
}

glm::dvec3 middle_of(const Entry& entry) {
    glm::dvec3 middle;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        middle[axis] = 0.5 * (static_cast<double>(entry.lower[i]) + entry.upper[i]);
    }
    return middle;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The median of the clusters' box centres, by component.
glm::dvec3 median_middle(const Hierarchy& hierarchy) {
    std::array<std::vector<double>, 3> middles;
    for (const Entry& entry : hierarchy.entries) {
        if (entry.count != 0) continue;
        const glm::dvec3 middle = middle_of(entry);
        for (std::size_t i = 0; i < 3; ++i) middles[i].push_back(middle[static_cast<int>(i)]);
    }
    return {median(middles[0]), median(middles[1]), median(middles[2])};
}

/// Boxes are enlarged by some 2^-30 of what is scaled to 1 (packet.cpp). Parts closer together than
/// this share of the whole would be met as one: then the whole is not what is scaled to 1.
constexpr double outlying_share = 0x1p-20;

/// The reach of all that is not outlying: that is, no further out than the median cluster divided
/// by outlying_share. Most often, this is everything.
double reach_of_most(const Hierarchy& hierarchy, const glm::dvec3& origin) {
    const double whole = reach_of(hierarchy.entries.front(), origin);
    std::vector<double> reaches;
    for (const Entry& entry : hierarchy.entries)
        if (entry.count == 0) reaches.push_back(reach_of(entry, origin));
    const double limit = median(reaches) / outlying_share;
    if (!(limit > 0) || whole <= limit) return whole;
    double reach = 0;
    for (const double each : reaches)
        if (each <= limit) reach = std::max(reach, each);
    return reach;
}

/// The origin for parallel rays: the centre, of the whole scene if nothing is outlying.
glm::dvec3 origin_of_parallel_rays(const Hierarchy& hierarchy) {
    const glm::dvec3 among_most = median_middle(hierarchy);
    const Entry& root = hierarchy.entries.front();
    return reach_of_most(hierarchy, among_most) < reach_of(root, among_most) ? among_most
                                                                             : middle_of(root);
}

} // namespace

OriginView view_from(const glm::dvec4& from, bool may_be_parallel, const Scene& scene,
                     const Hierarchy& hierarchy, const Places& places, const Predicates& predicates,
                     int threads) {
    OriginView view;
    view.scene = &scene;
    view.hierarchy = &hierarchy;
    view.places = &places;
    const glm::dvec3 middle = origin_of_parallel_rays(hierarchy);
    const double around = reach_of_most(hierarchy, middle);
    const bool far = may_be_parallel && from.w != 0 && around > 0 &&
                     largest(glm::dvec3(from) - middle) > far_light * around;
    view.parallel = from.w == 0 || far;
    view.origin = view.parallel ? middle : glm::dvec3(from);
    const double reach = reach_of_most(hierarchy, view.origin);
    const int room = far ? 3 : (view.parallel ? 2 : 1);
    view.scale = reach > 0 ? std::exp2(-std::ilogb(reach) - room) : 1;
    if (view.parallel) {
        view.shear = shear_along(
            far ? (glm::dvec3(from) - view.origin) * view.scale : glm::dvec3(from), far);
        shear_entries(hierarchy, view);
    } else {
        view.entries.reserve(hierarchy.entries.size());
        for (const Entry& entry : hierarchy.entries)
            view.entries.push_back(relative(entry, view.origin, view.scale));
    }
    // The children of an entry come after it, so each group is sorted before it is visited.
    sort_children(view.entries, view.parallel);

    view.side.resize(scene.triangles.size());
    parallel_for_all(scene.triangles.size(), threads, [&](std::size_t i) {
        view.side[i] = side_of(from, corners(scene, static_cast<std::uint32_t>(i)), predicates);
    });
    return view;
}

} // namespace shadowproof
