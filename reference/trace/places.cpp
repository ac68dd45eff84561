#include "reference/trace/places.h"

#include "reference/exact/norms.h"
#include "reference/parallel.h"
#include "reference/trace/view.h"
#include "scenes/mesh/first_of_same.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// The same for all orders of the corners.
std::uint64_t place_hash(const Corners& t) {
    return hash_of(t.a) + hash_of(t.b) + hash_of(t.c);
}

/// Of the normal, divided by its largest component, and of the plane's place, both rounded so
/// coarsely that they are most often equal in one plane. 0 where rounding may be all there is of
/// the normal, whose components are off by 8 u l^2 (view.cpp), and nowhere else.
std::uint64_t plane_hash(const Corners& t, double size) {
    constexpr double u = 0x1p-53;
    constexpr double steps = 0x1p40;
    const glm::dvec3 ab = t.b - t.a;
    const glm::dvec3 ac = t.c - t.a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double l = std::max(largest(ab), largest(ac));
    if (!(largest(normal) > 0x1p10 * u * l * l)) return 0;
    const glm::dvec3 length = glm::abs(normal);
    const double component = length.x == largest(normal)   ? normal.x
                             : length.y == largest(normal) ? normal.y
                                                           : normal.z;
    const glm::dvec3 direction = normal / component;
    const double offset = glm::dot(direction, t.a) / size;
    return mixed(hash_of(glm::round(direction * steps)) +
                 std::bit_cast<std::uint64_t>(std::round(offset * steps) + 0.0)) |
           1U;
}

bool lies_in_plane(const Predicates& predicates, const Corners& t, const Corners& plane) {
    return std::ranges::all_of(std::array{t.a, t.b, t.c}, [&](const glm::dvec3& corner) {
        return predicates.side({corner, 1}, plane).sign == 0;
    });
}

} // namespace

bool are_coplanar(const Corners& t, const Corners& u) {
    return lies_in_plane(Predicates{}, u, t);
}

std::vector<std::uint32_t> Places::firsts() const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < first.size(); ++i)
        if (first[i] == i) found.push_back(i);
    return found;
}

bool have_same_corners(const Corners& t, const Corners& u) {
    const std::array<glm::dvec3, 3> corners{t.a, t.b, t.c};
    const std::array<glm::dvec3, 3> others{u.a, u.b, u.c};
    return std::is_permutation(corners.begin(), corners.end(), others.begin());
}

Places find_places(const Scene& scene, const Predicates& predicates, int threads) {
    const std::size_t count = scene.triangles.size();
    double size = 0;
    for (const glm::vec3& position : scene.positions)
        size = std::max(size, largest(glm::dvec3(position)));
    // What is decided for one triangle holds for its copies only where nothing is left out of them:
    // each with a mask gets a place of its own.
    const std::vector<std::uint32_t> masks = masks_of_triangles(scene);
    const auto has_mask = [&](std::size_t i) { return !masks.empty() && masks[i] != no_mask; };
    std::vector<std::uint64_t> of_place(count);
    std::vector<std::uint64_t> of_plane(count);
    parallel_for_all(count, threads, [&](std::size_t i) {
        const Corners t = corners(scene, static_cast<std::uint32_t>(i));
        of_place[i] = has_mask(i) ? mixed(place_hash(t) + i) : place_hash(t);
        of_plane[i] = plane_hash(t, size);
    });
    const auto at = [&](std::uint32_t triangle) { return corners(scene, triangle); };

    Places places;
    places.first = first_of_same(of_place, [&](std::uint32_t i, std::uint32_t j) {
        return !has_mask(i) && !has_mask(j) && have_same_corners(at(i), at(j));
    });
    // Many nearly in one plane have one hash, and would all be held against each other.
    constexpr int patience = 8;
    places.plane = first_of_same(
        of_plane,
        [&](std::uint32_t i, std::uint32_t j) {
            return of_plane[i] != 0 && lies_in_plane(predicates, at(j), at(i));
        },
        patience);
    places.next.assign(count, no_triangle);
    std::vector<std::uint32_t> last = places.first;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t first = places.first[i];
        if (first == i) continue;
        places.next[last[first]] = i;
        last[first] = i;
    }
    return places;
}

} // namespace shadowproof
