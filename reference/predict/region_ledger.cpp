#include "reference/predict/region_ledger.h"

#include "reference/trace/faces.h"
#include "reference/trace/state.h"
#include "scenes/mesh/split_far_ends.h"
#include "scenes/mesh/topology.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <tuple>

namespace shadowproof {

namespace {

/// d x m, not normalised, where m is the direction in which the eye is moved to break ties
/// (Predicates::shadow_edge_untied): (e, e^2, e^3), with an e that distinguishes the three whatever
/// the sizes in d, and that no rounding reaches.
glm::dvec3 cross_with_move(const glm::dvec3& d) {
    constexpr double e = 0x1p-60;
    glm::dvec3 sum(0);
    double weight = 1;
    for (const glm::dvec3& part :
         {glm::dvec3(0, d.z, -d.y), glm::dvec3(-d.z, 0, d.x), glm::dvec3(d.y, -d.x, 0)}) {
        if (part == glm::dvec3(0)) continue;
        sum += part * (weight / largest(part));
        weight *= e;
    }
    return sum;
}

/// v times a power of two that keeps products of it far from the smallest doubles.
glm::dvec3 enlarged(const glm::dvec3& v) {
    return largest(v) < 0x1p-500 ? v * 0x1p500 : v;
}

/// v x (eye - p), not normalised, for a p that may be next to the eye; where both are equal, that
/// of the moved eye.
glm::dvec3 plane_through_eye(const glm::dvec3& v, const glm::dvec3& eye, const glm::dvec3& p) {
    const glm::dvec3 plane = glm::cross(enlarged(v), enlarged(eye - p));
    return plane == glm::dvec3(0) ? cross_with_move(v) : plane;
}

/// As side_plane. Where the light is next to the edge, a product of doubles keeps few of its 53
/// bits, or none: where it loses 20, or comes near the smallest doubles, it is computed in rational
/// numbers.
glm::dvec3 accurate_side_plane(const glm::dvec4& light, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 plane = side_plane(light, a, b);
    const double least = 0x1p-20 * largest(a - glm::dvec3(light)) * largest(b - a);
    if (light.w == 0 || largest(plane) > std::max(least, 0x1p-500)) return plane;
    return normal_through_light(light, a, b);
}

/// Normal of the plane through the eye and an edge, the same for both directions of the edge. If
/// the eye lies on its line: (a - e m) x (b - e m), e -> 0, is e (b - a) x m.
glm::dvec3 edge_plane(const glm::dvec3& eye, const glm::dvec3& a, const glm::dvec3& b) {
    if (before(b, a)) return edge_plane(eye, b, a);
    const glm::dvec3 plane = glm::cross(enlarged(a - eye), enlarged(b - eye));
    return plane == glm::dvec3(0) ? cross_with_move(b - a) : plane;
}

/// The eye's side of a plane as computed in double, with the exact sign, ties broken as the counts
/// at the eye break them (Predicates::shadow_edge_untied): only then do the crossings of a ray and
/// those counts add up. Where doubles have the wrong sign the eye's distance is next to nothing.
double with_sign(double side, int sign) {
    return sign * side > 0 ? side : sign * std::numeric_limits<double>::denorm_min();
}

/// Shadow volumes are counted along lines of sight that meet in the eye.
const glm::dvec3& eye_of(const Tracer::State& state) {
    assert(!state.scene->camera.is_orthographic());
    return state.scene->camera.eye;
}

EyeRay any_ray(const Tracer::State& state) {
    return {eye_of(state), state.scene->camera.forward, state.light};
}
constexpr RayPoint at_eye{.kind = RayPoint::Kind::depth, .surface = {}, .depth = 0};

/// The eye's side of the plane of the side over the edge from a to b.
double eye_against_side(const Tracer::State& state, const glm::dvec3& plane, const glm::dvec3& a,
                        const glm::dvec3& b) {
    return with_sign(glm::dot(eye_of(state) - side_point(state.light, a, b), plane),
                     state.predicates.shadow_edge_untied(any_ray(state), at_eye, a, b).sign);
}

/// The eye's side of a light cap; positive behind it.
double eye_against_cap(const Tracer::State& state, std::uint32_t triangle, const Corners& t,
                       const glm::dvec3& plane) {
    int sign = state.from_eye.side[triangle];
    // The predicate's plane points to the front, the cap's into the volume.
    if (sign == 0) sign = -state.predicates.side_of_point_untied(any_ray(state), at_eye, t).sign;
    return with_sign(glm::dot(eye_of(state) - t.a, plane), sign);
}

/// Signs of a function that is linear in the direction, over a region.
struct Signs {
    bool some_negative = false;
    bool some_positive = false; ///< or zero

    Signs(const std::array<glm::dvec3, 4>& corners, const glm::dvec3& plane) {
        for (const glm::dvec3& corner : corners)
            (glm::dot(corner, plane) < 0 ? some_negative : some_positive) = true;
    }
    bool mixed() const { return some_negative && some_positive; }
};

std::vector<std::uint32_t> casting_triangles(const Tracer::State& state) {
    std::vector<std::uint32_t> casting;
    for (std::uint32_t i = 0; i < state.from_light.side.size(); ++i)
        if (state.from_light.side[i] < 0) casting.push_back(i);
    return casting;
}

/// Where the edges of `edges`, sorted by a and b, begin at each position.
std::vector<std::size_t> first_of_each(const std::vector<SurplusEdge>& edges, std::size_t size) {
    std::vector<std::size_t> first(size + 1, 0);
    for (const SurplusEdge& edge : edges) ++first[edge.a + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    return first;
}

/// Planes between neighbouring corners and the eye; normals point out of the region.
std::array<glm::dvec3, 4> walls_of(const std::array<glm::dvec3, 4>& corners) {
    std::array<glm::dvec3, 4> walls{};
    const glm::dvec3 middle = corners[0] + corners[1] + corners[2] + corners[3];
    for (std::size_t i = 0; i < 4; ++i) {
        walls[i] = glm::cross(corners[i], corners[(i + 1) % 4]);
        if (glm::dot(walls[i], middle) > 0) walls[i] = -walls[i];
    }
    return walls;
}

} // namespace

Silhouette::Silhouette(const Tracer& tracer) {
    const Tracer::State& state = tracer.state();
    const Scene& scene = *state.scene;
    const std::vector<std::uint32_t> welded = weld_by_position(scene.positions);
    const std::vector<std::uint32_t> casting = casting_triangles(state);
    const std::vector<SurplusEdge> edges = boundary(scene, welded, casting);
    const std::vector<std::size_t> first = first_of_each(edges, scene.positions.size());

    constexpr std::uint32_t unnumbered = 0xffffffffU;
    std::vector<std::uint32_t> numbers(scene.positions.size(), unnumbered);
    const auto number_of = [&](std::uint32_t position) {
        if (numbers[position] == unnumbered) {
            numbers[position] = static_cast<std::uint32_t>(vertices_.size());
            const glm::dvec3 at(scene.positions[position]);
            const glm::dvec3 from_light = state.light.w * at - glm::dvec3(state.light);
            vertices_.push_back({at, plane_through_eye(from_light, eye_of(state), at)});
        }
        return numbers[position];
    };
    for (const SurplusEdge& edge : edges) {
        const glm::dvec3 a(scene.positions[edge.a]);
        const glm::dvec3 b(scene.positions[edge.b]);
        const bool reversed = before(b, a);
        Side& side = sides_.emplace_back();
        side.p = number_of(reversed ? edge.b : edge.a);
        side.q = number_of(reversed ? edge.a : edge.b);
        // The triangle on the left of a to b faces the light: its side runs back.
        side.surplus = reversed ? edge.surplus : -edge.surplus;
        side.plane = reversed ? accurate_side_plane(state.light, b, a)
                              : accurate_side_plane(state.light, a, b);
        side.eye = eye_against_side(state, side.plane, reversed ? b : a, reversed ? a : b);
        side.edge = edge_plane(eye_of(state), a, b);
        side.number = static_cast<std::uint32_t>(sides_.size() - 1);
        side.flipped = edge.a > edge.b;
    }
    for (const std::uint32_t triangle : casting)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = welded[scene.triangles[triangle][k]];
            const std::uint32_t b = welded[scene.triangles[triangle][(k + 1) % 3]];
            for (std::size_t i = first[a]; i < first[a + 1]; ++i) {
                if (edges[i].b != b || sides_[i].triangle != no_triangle) continue;
                sides_[i].triangle = triangle;
                sides_[i].part = static_cast<Crossing::Part>(k);
            }
        }
}

RegionLedger::RegionLedger(const Tracer& tracer, const Silhouette& silhouette,
                           const std::array<glm::dvec3, 4>& corners)
    : tracer_(tracer) {
    const std::vector<Silhouette::Vertex>& vertices = silhouette.vertices();
    gather_sides(
        silhouette.sides(), vertices.size(),
        [&](std::size_t vertex) { return vertices[vertex].plane; }, corners);
    gather_caps(corners);
}

RegionLedger::RegionLedger(const RegionLedger& outer, const std::array<glm::dvec3, 4>& corners)
    : tracer_(outer.tracer_), flipped_(outer.flipped_) {
    const Vertices& vertices = outer.vertices_;
    gather_sides(
        outer.sides_, vertices.x.size(),
        [&](std::size_t i) { return glm::dvec3(vertices.x[i], vertices.y[i], vertices.z[i]); },
        corners);
    for (const Cap& cap : outer.caps_)
        if (cap.may_be_met(corners)) caps_.push_back(cap);
    if (outer.ends_) ends_ = std::make_shared<RegionLedger>(*outer.ends_, corners);
}

// A ray eye + t D crosses the side over p and q, as seen from the light L = (l, w), where
//   p and q lie on different sides of the plane through the ray and L: the signs of
//     det(w p - l, eye - p, D) and det(w q - l, eye - q, D) differ;
//   with N = (w p - l) x (q - p), t = -(eye - p).N / D.N is positive;
//   the crossing lies beyond the edge: det(D, p - eye, q - eye) has the sign of (eye - p).N, as
//     that determinant is m / t times it where the crossing is (1 + w m) e - m l, e on the edge.
// All are linear in D, so what holds at no corner of a region holds nowhere in it.
template <class PlaneOf>
void RegionLedger::gather_sides(const std::vector<Silhouette::Side>& sides,
                                std::size_t vertex_count, const PlaneOf& plane_of,
                                const std::array<glm::dvec3, 4>& corners) {
    std::vector<Signs> signs;
    signs.reserve(vertex_count);
    for (std::size_t i = 0; i < vertex_count; ++i) signs.emplace_back(corners, plane_of(i));
    for (const Silhouette::Side& side : sides) {
        const Signs& p = signs[side.p];
        const Signs& q = signs[side.q];
        if (!p.mixed() && !q.mixed() && p.some_negative == q.some_negative) continue;
        const double eye = side.eye;
        const Signs ray(corners, side.plane);
        if (eye < 0 ? !ray.some_positive : !ray.some_negative) continue;
        const Signs beyond(corners, side.edge);
        if (eye < 0 ? !beyond.some_negative : !beyond.some_positive) continue;
        sides_.push_back(side);
    }
    number_vertices(plane_of);
}

template <class PlaneOf>
void RegionLedger::number_vertices(const PlaneOf& plane_of) {
    std::vector<std::uint32_t> used;
    for (const Silhouette::Side& side : sides_) used.insert(used.end(), {side.p, side.q});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::uint32_t vertex : used) {
        const glm::dvec3 plane = plane_of(vertex);
        vertices_.x.push_back(plane.x);
        vertices_.y.push_back(plane.y);
        vertices_.z.push_back(plane.z);
    }
    behind_.resize(used.size());
    const auto number = [&](std::uint32_t vertex) {
        return static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), vertex) -
                                          used.begin());
    };
    for (Silhouette::Side& side : sides_) {
        side.p = number(side.p);
        side.q = number(side.q);
    }
}

void RegionLedger::gather_caps(const std::array<glm::dvec3, 4>& corners) {
    const Tracer::State& state = tracer_.state();
    const std::array<glm::dvec3, 4> walls = walls_of(corners);
    const auto may_meet = [&](const Box& box) {
        const glm::dvec3 lower(box.lower);
        const glm::dvec3 upper(box.upper);
        const glm::dvec3 centre = 0.5 * (lower + upper) - eye_of(state);
        const glm::dvec3 half = 0.5 * (upper - lower);
        return std::all_of(walls.begin(), walls.end(), [&](const glm::dvec3& wall) {
            // 2^-40 of the terms' sizes leaves room for thousands of roundings.
            const double reach = glm::dot(glm::abs(wall), half);
            const double size = glm::dot(glm::abs(wall), glm::abs(centre)) + reach;
            return glm::dot(wall, centre) - reach <= 0x1p-40 * size;
        });
    };
    state.clusters.for_each_in(may_meet, [&](const Cluster& cluster) {
        for (const std::uint32_t first : cluster.triangles)
            for (std::uint32_t triangle = first; triangle != no_triangle;
                 triangle = state.places.next[triangle])
                gather_cap(triangle, corners);
    });
}

void RegionLedger::gather_cap(std::uint32_t triangle, const std::array<glm::dvec3, 4>& corners) {
    const Tracer::State& state = tracer_.state();
    if (state.from_light.side[triangle] >= 0) return;
    const Corners t = shadowproof::corners(*state.scene, triangle);
    Cap cap;
    cap.triangle = triangle;
    const Corners from = from_short_edge(t);
    cap.plane = cap_plane(from);
    cap.eye = eye_against_cap(state, triangle, from, cap.plane);
    const std::array<glm::dvec3, 4> loop{t.a, t.b, t.c, t.a};
    for (std::size_t k = 0; k < 3; ++k) {
        cap.edges[k] = edge_plane(eye_of(state), loop[k], loop[k + 1]);
        cap.reversed[k] = before(loop[k + 1], loop[k]);
    }
    if (cap.may_be_met(corners)) caps_.push_back(cap);
}

bool RegionLedger::Cap::may_be_met(const std::array<glm::dvec3, 4>& corners) const {
    bool may_be_left = true;
    bool may_be_right = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const Signs signs(corners, edges[k]);
        may_be_left = may_be_left && (reversed[k] ? signs.some_positive : signs.some_negative);
        may_be_right = may_be_right && (reversed[k] ? signs.some_negative : signs.some_positive);
    }
    return may_be_left || may_be_right;
}

bool RegionLedger::Cap::is_met_by(const glm::dvec3& direction) const {
    const auto left = [&](std::size_t k) {
        return (glm::dot(direction, edges[k]) < 0) != reversed[k];
    };
    return left(0) == left(1) && left(1) == left(2);
}

void RegionLedger::crossings(const glm::dvec3& direction, std::vector<Crossing>& found) {
    found.clear();
    for (std::size_t i = 0; i < behind_.size(); ++i)
        behind_[i] = direction.x * vertices_.x[i] + direction.y * vertices_.y[i] +
                         direction.z * vertices_.z[i] <
                     0;
    for (const Silhouette::Side& side : sides_) {
        if (behind_[side.p] == behind_[side.q]) continue;
        const double slope = glm::dot(direction, side.plane);
        const double eye = side.eye;
        if (slope == 0 || (slope < 0) == (eye < 0)) continue;
        if ((glm::dot(direction, side.edge) < 0) != (eye < 0)) continue;
        const int change = slope > 0 ? side.surplus : -side.surplus;
        for (int i = 0; i < std::abs(change); ++i)
            found.push_back({-eye / slope, change > 0 ? 1 : -1, side.part, side.triangle,
                             side.plane, side.number, side.flipped});
    }
    for (const Cap& cap : caps_) {
        if (!cap.is_met_by(direction)) continue;
        const double slope = glm::dot(direction, cap.plane);
        if (slope == 0 || (slope < 0) == (cap.eye < 0)) continue;
        const bool flipped = cap.triangle < flipped_.size() && flipped_[cap.triangle] != 0;
        found.push_back({-cap.eye / slope, slope > 0 ? 1 : -1, Crossing::Part::light_cap,
                         cap.triangle, cap.plane, 0, flipped});
    }
    if (ends_) cross_ends(direction, found);
    std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
        if (a.depth != b.depth) return a.depth < b.depth;
        return std::tuple(!a.is_side() ? 0 : 1, a.change, a.triangle) <
               std::tuple(!b.is_side() ? 0 : 1, b.change, b.triangle);
    });
}

std::vector<glm::dvec3> RegionLedger::outlines(const std::array<glm::dvec3, 4>& corners) const {
    std::vector<glm::dvec3> planes;
    const auto add = [&](const glm::dvec3& plane) {
        if (Signs(corners, plane).mixed()) planes.push_back(plane);
    };
    for (std::size_t i = 0; i < vertices_.x.size(); ++i)
        add({vertices_.x[i], vertices_.y[i], vertices_.z[i]});
    for (const Silhouette::Side& side : sides_) add(side.edge);
    for (const Cap& cap : caps_)
        for (const glm::dvec3& edge : cap.edges) add(edge);
    if (!ends_) return planes;
    const std::vector<glm::dvec3> ends = ends_->outlines(corners);
    planes.insert(planes.end(), ends.begin(), ends.end());
    return planes;
}

std::vector<glm::dvec3>
RegionLedger::vanishing_lines(const std::array<glm::dvec3, 4>& corners) const {
    std::vector<glm::dvec3> planes;
    for (const Silhouette::Side& side : sides_)
        if (Signs(corners, side.plane).mixed()) planes.push_back(side.plane);
    return planes;
}

int RegionLedger::edge_on_sides(const std::array<glm::dvec3, 4>& corners) const {
    int edge_on = 0;
    for (const Silhouette::Side& side : sides_)
        if (Signs(corners, side.plane).mixed() && Signs(corners, side.edge).mixed())
            edge_on += std::abs(side.surplus);
    return edge_on;
}

std::vector<std::uint32_t> RegionLedger::light_caps() const {
    std::vector<std::uint32_t> triangles;
    for (const Cap& cap : caps_) triangles.push_back(cap.triangle);
    return triangles;
}

void RegionLedger::cross_ends(const glm::dvec3& direction, std::vector<Crossing>& found) {
    ends_->crossings(direction, found_at_ends_);
    for (Crossing& crossing : found_at_ends_) {
        crossing.change = -crossing.change;
        if (!crossing.is_side()) {
            crossing.part = Crossing::Part::dark_cap;
            found.push_back(crossing);
            continue;
        }
        const auto same = std::find_if(found.begin(), found.end(), [&](const Crossing& other) {
            return other.is_side() && other.edge == crossing.edge &&
                   other.change == -crossing.change;
        });
        if (same != found.end())
            found.erase(same);
        else
            found.push_back(crossing);
    }
}

} // namespace shadowproof
