#include "scenes/mesh/split_far_ends.h"

#include "scenes/mesh/topology.h"
#include "scenes/mesh/touching_light.h"

#include <gmpxx.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

namespace shadowproof {

namespace {

using Rational = std::array<mpq_class, 3>;

Rational difference(const glm::dvec3& p, const glm::dvec3& q) {
    return {mpq_class(p.x) - mpq_class(q.x), mpq_class(p.y) - mpq_class(q.y),
            mpq_class(p.z) - mpq_class(q.z)};
}

Rational from_light(const Scene& scene, std::uint32_t position) {
    return difference(scene.positions[position], chosen_light(scene).position);
}

mpq_class dot(const Rational& p, const Rational& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

Rational minus(const Rational& p, const Rational& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

Rational cross(const Rational& p, const Rational& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// The normalised vector; nothing for the zero vector.
std::optional<glm::dvec3> direction_of(const Rational& v) {
    const mpq_class largest =
        std::max({mpq_class(abs(v[0])), mpq_class(abs(v[1])), mpq_class(abs(v[2]))});
    if (largest == 0) return std::nullopt;
    return glm::normalize(glm::dvec3(mpq_class(v[0] / largest).get_d(),
                                     mpq_class(v[1] / largest).get_d(),
                                     mpq_class(v[2] / largest).get_d()));
}

/// The point of an edge nearest to the origin, as the fraction of the way from a to b.
mpq_class next_along(const Rational& a, const Rational& b) {
    const Rational along = minus(b, a);
    const mpq_class squared = dot(along, along);
    if (squared == 0) return 0;
    const mpq_class t = -dot(a, along) / squared;
    return t < 0 ? mpq_class(0) : (t > 1 ? mpq_class(1) : t);
}

Rational between(const Rational& a, const Rational& b, const mpq_class& t) {
    const Rational along = minus(b, a);
    return {a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]};
}

/// The point of a triangle that is nearest to the origin.
Rational nearest_point(const std::array<Rational, 3>& corners) {
    const Rational normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    bool over_face = true;
    for (std::size_t k = 0; k < 3; ++k)
        over_face = over_face && dot(cross(corners[k], corners[(k + 1) % 3]), normal) >= 0;
    if (over_face) {
        const mpq_class height = dot(corners[0], normal) / dot(normal, normal);
        return {normal[0] * height, normal[1] * height, normal[2] * height};
    }
    Rational nearest = corners[0];
    for (std::size_t k = 0; k < 3; ++k) {
        const Rational& a = corners[k];
        const Rational& b = corners[(k + 1) % 3];
        const Rational point = between(a, b, next_along(a, b));
        if (dot(point, point) < dot(nearest, nearest)) nearest = point;
    }
    return nearest;
}

template <class Map, class Key>
const std::uint32_t* entry(const Map& map, const Key& key) {
    const auto found = map.find(key);
    return found == map.end() ? nullptr : &found->second;
}

/// Collects the directions of a scene's triangles, one after the other.
struct Splitter {
    const Scene& scene;
    glm::dvec4 light;
    SplitFarEnds split{};

    std::uint32_t add(const glm::dvec3& direction) {
        split.directions.push_back(direction);
        return static_cast<std::uint32_t>(split.directions.size() - 1);
    }

    void add_position(std::uint32_t position) {
        if (split.of_position.contains(position) || !is_lost_in_floats(scene, position)) return;
        if (const auto direction = direction_of(from_light(scene, position)))
            split.of_position[position] = add(*direction);
    }

    void add_edge(std::uint32_t a, std::uint32_t b) {
        const std::array edge{std::min(a, b), std::max(a, b)};
        if (split.across_edge.contains(edge)) return;
        const Rational from = from_light(scene, a);
        const Rational to = from_light(scene, b);
        const mpq_class t = next_along(from, to);
        if (t <= 0 || t >= 1) return;
        if (const auto direction = direction_of(between(from, to, t)))
            split.across_edge[edge] = add(*direction);
    }

    void add_triangle(std::uint32_t triangle, glm::uvec3 corners) {
        bool touches = touches_light(scene, triangle);
        for (int k = 0; k < 3; ++k) {
            add_position(corners[k]);
            if (!edge_touches_light(scene, corners[k], corners[(k + 1) % 3])) continue;
            touches = true;
            add_edge(corners[k], corners[(k + 1) % 3]);
        }
        if (!touches) return;
        const auto direction =
            direction_of(nearest_point({from_light(scene, corners.x), from_light(scene, corners.y),
                                        from_light(scene, corners.z)}));
        if (direction) split.behind_triangle[triangle] = add(*direction);
    }
};

} // namespace

const std::uint32_t* SplitFarEnds::across(std::uint32_t a, std::uint32_t b) const {
    if (across_edge.empty()) return nullptr;
    return entry(across_edge,
                 std::array{std::min(welded[a], welded[b]), std::max(welded[a], welded[b])});
}

const std::uint32_t* SplitFarEnds::of(std::uint32_t position) const {
    return of_position.empty() ? nullptr : entry(of_position, welded[position]);
}

const std::uint32_t* SplitFarEnds::behind(std::uint32_t triangle) const {
    return entry(behind_triangle, triangle);
}

glm::dvec3 normal_through_light(const glm::dvec3& light, const glm::dvec3& a, const glm::dvec3& b) {
    const Rational from = difference(a, light);
    return direction_of(cross(from, difference(b, a))).value_or(glm::dvec3(0));
}

SplitFarEnds split_far_ends(const Scene& casters) {
    Splitter splitter{casters, homogeneous(chosen_light(casters))};
    if (splitter.light.w == 0) return splitter.split;
    std::vector<std::uint32_t> welded;
    for (std::uint32_t triangle = 0; triangle < casters.triangles.size(); ++triangle) {
        if (is_far_from_light(casters, triangle) || side(casters, triangle, splitter.light) <= 0)
            continue;
        if (welded.empty()) welded = weld_by_position(casters.positions);
        const glm::uvec3 corners = casters.triangles[triangle];
        splitter.add_triangle(triangle, {welded[corners.x], welded[corners.y], welded[corners.z]});
    }
    if (!splitter.split.empty()) splitter.split.welded = std::move(welded);
    return splitter.split;
}

std::vector<glm::vec3> points_towards_infinity(const Scene& scene, const SplitFarEnds& split) {
    return points_along(scene, split, std::max(1.0, glm::length(chosen_light(scene).position)));
}

std::vector<glm::vec3> points_along(const Scene& scene, const SplitFarEnds& split,
                                    double distance) {
    std::vector<glm::vec3> points;
    points.reserve(split.directions.size());
    for (const glm::dvec3& direction : split.directions)
        points.emplace_back(chosen_light(scene).position + distance * direction);
    return points;
}

} // namespace shadowproof
