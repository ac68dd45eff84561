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

/// As side_plane. Where the light is next to the edge, a product of doubles keeps few of its 53
/// bits, or none: where it loses 20, or comes near the smallest doubles, it is computed in rational
/// numbers.
glm::dvec3 accurate_side_plane(const glm::dvec4& light, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 plane = side_plane(light, a, b);
    const double least = 0x1p-20 * largest(a - glm::dvec3(light)) * largest(b - a);
    if (light.w == 0 || largest(plane) > std::max(least, 0x1p-500)) return plane;
    return normal_through_light(light, a, b);
}

/// The eye's side of a plane as computed in double, with the exact sign, ties broken as the counts
/// at the eye break them (Predicates::shadow_edge_untied): only then do the crossings of a ray and
/// those counts add up. Where doubles have the wrong sign the eye's distance is next to nothing.
double with_sign(double side, int sign) {
    return sign * side > 0 ? side : sign * std::numeric_limits<double>::denorm_min();
}

EyeRay any_ray(const Tracer::State& state) {
    return state.ray(eye_line(state.scene->camera));
}

RayPoint eye_of(const Camera& camera) {
    return {.kind = camera.is_orthographic() ? RayPoint::Kind::eye : RayPoint::Kind::depth,
            .surface = {},
            .depth = 0};
}

/// The plane of a face with this normal through p; `sign`: that of the eye's side.
FacePlane face_plane(const Camera& camera, const glm::dvec3& normal, const glm::dvec3& p,
                     int sign) {
    const double side = camera.is_orthographic() ? -glm::dot(camera.forward, normal)
                                                 : glm::dot(camera.eye - p, normal);
    return {normal, with_sign(side, sign), p};
}

/// The plane of the side over the edge from a to b.
FacePlane plane_of_side(const Tracer::State& state, const glm::dvec3& a, const glm::dvec3& b) {
    const Camera& camera = state.scene->camera;
    const EyeRay ray = any_ray(state);
    // The eye at infinity is on the side that lines of sight come from.
    const int sign = camera.is_orthographic()
                         ? -state.predicates.towards_shadow_edge_untied(ray, a, b).sign
                         : state.predicates.shadow_edge_untied(ray, eye_of(camera), a, b).sign;
    return face_plane(camera, accurate_side_plane(state.light, a, b), side_point(state.light, a, b),
                      sign);
}

/// The plane of a light cap; its eye's side is positive behind it.
FacePlane plane_of_cap(const Tracer::State& state, std::uint32_t triangle, const Corners& t) {
    const Camera& camera = state.scene->camera;
    int sign = state.from_eye.side[triangle];
    // The predicate's plane points to the front, the cap's into the volume.
    if (sign == 0)
        sign = -state.predicates.side_of_point_untied(any_ray(state), eye_of(camera), t).sign;
    return face_plane(camera, cap_plane(t), t.a, sign);
}

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

/// A plane through neighbouring corners and the eye, and a point of it; the normal points out of
/// the region.
struct Wall {
    glm::dvec3 normal{0, 0, 0};
    glm::dvec3 point{0, 0, 0};
};

std::array<Wall, 4> walls_of(const Camera& camera, const std::array<glm::dvec3, 4>& corners) {
    std::array<Wall, 4> walls{};
    const glm::dvec3 sum = corners[0] + corners[1] + corners[2] + corners[3];
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3& corner = corners[i];
        const glm::dvec3 along = corners[(i + 1) % 4] - corner;
        const glm::dvec3 normal = glm::cross(direction_of(camera, corner), along);
        const glm::dvec3 inwards = camera.is_orthographic() ? sum - 4.0 * corner : sum;
        walls[i] = {glm::dot(normal, inwards) > 0 ? -normal : normal, start_of(camera, corner)};
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
            vertices_.push_back({at, plane_through_eye(scene.camera, from_light, at)});
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
        side.plane = reversed ? plane_of_side(state, b, a) : plane_of_side(state, a, b);
        side.edge = edge_plane(scene.camera, a, b);
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
    : tracer_(tracer), is_parallel_(tracer.scene().camera.is_orthographic()) {
    const std::vector<Silhouette::Vertex>& vertices = silhouette.vertices();
    gather_sides(
        silhouette.sides(), vertices.size(),
        [&](std::size_t vertex) { return vertices[vertex].plane; }, corners);
    gather_caps(corners);
}

RegionLedger::RegionLedger(const RegionLedger& outer, const std::array<glm::dvec3, 4>& corners)
    : tracer_(outer.tracer_), is_parallel_(outer.is_parallel_), flipped_(outer.flipped_) {
    const Vertices& vertices = outer.vertices_;
    gather_sides(
        outer.sides_, vertices.x.size(), [&](std::size_t i) { return vertices.plane(i); }, corners);
    for (const Cap& cap : outer.caps_)
        if (cap.may_be_met(corners)) caps_.push_back(cap);
    if (outer.ends_) cut_off(RegionLedger(*outer.ends_, corners), outer.span_);
}

// A ray eye + t D crosses the side over p and q, as seen from the light L = (l, w), where
//   p and q lie on different sides of the plane through the ray and L: the signs of
//     det(w p - l, eye - p, D) and det(w q - l, eye - q, D) differ;
//   with N = (w p - l) x (q - p), t = -(eye - p).N / D.N is positive;
//   the crossing lies beyond the edge: det(D, p - eye, q - eye) has the sign of (eye - p).N, as
//     that determinant is m / t times it where the crossing is (1 + w m) e - m l, e on the edge.
// All are linear in D, so what holds at no corner of a region holds nowhere in it. A line S + t D
// of an orthographic camera crosses it likewise: with -D for eye - p, and p - S for what D was
// multiplied with, the functions are affine in S; any t is ahead of the eye, and the last factor is
// m.
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
        const double eye = side.plane.eye;
        if (!is_parallel_) {
            const Signs ray(corners, {side.plane.normal, 0});
            if (eye < 0 ? !ray.some_positive : !ray.some_negative) continue;
        }
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
        const SightPlane plane = plane_of(vertex);
        vertices_.x.push_back(plane.normal.x);
        vertices_.y.push_back(plane.normal.y);
        vertices_.z.push_back(plane.normal.z);
        vertices_.offset.push_back(plane.offset);
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
    const std::array<Wall, 4> walls = walls_of(state.scene->camera, corners);
    const auto may_meet = [&](const Box& box) {
        const glm::dvec3 lower(box.lower);
        const glm::dvec3 upper(box.upper);
        const glm::dvec3 centre = 0.5 * (lower + upper);
        const glm::dvec3 half = 0.5 * (upper - lower);
        return std::all_of(walls.begin(), walls.end(), [&](const Wall& wall) {
            // 2^-40 of the terms' sizes leaves room for thousands of roundings.
            const glm::dvec3 from_wall = centre - wall.point;
            const double reach = glm::dot(glm::abs(wall.normal), half);
            const double size = glm::dot(glm::abs(wall.normal), glm::abs(from_wall)) + reach;
            return glm::dot(wall.normal, from_wall) - reach <= 0x1p-40 * size;
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
    cap.plane = plane_of_cap(state, triangle, from);
    const std::array<glm::dvec3, 4> loop{t.a, t.b, t.c, t.a};
    for (std::size_t k = 0; k < 3; ++k) {
        cap.edges[k] = edge_plane(state.scene->camera, loop[k], loop[k + 1]);
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

bool RegionLedger::Cap::is_met_by(const glm::dvec3& line) const {
    const auto left = [&](std::size_t k) { return (edges[k].side(line) < 0) != reversed[k]; };
    return left(0) == left(1) && left(1) == left(2);
}

std::optional<RegionLedger::Meeting> RegionLedger::meet(const FacePlane& plane,
                                                        const glm::dvec3& line) const {
    const double eye = plane.eye;
    if (is_parallel_) return Meeting{glm::dot(line - plane.point, plane.normal) / eye, eye < 0};
    const double slope = glm::dot(line, plane.normal);
    if (slope == 0 || (slope < 0) == (eye < 0)) return std::nullopt;
    return Meeting{-eye / slope, slope > 0};
}

void RegionLedger::crossings(const glm::dvec3& line, std::vector<Crossing>& found) {
    found.clear();
    for (std::size_t i = 0; i < behind_.size(); ++i) behind_[i] = vertices_.plane(i).side(line) < 0;
    for (const Silhouette::Side& side : sides_) {
        if (behind_[side.p] == behind_[side.q]) continue;
        const std::optional<Meeting> met = meet(side.plane, line);
        if (!met || (side.edge.side(line) < 0) != (side.plane.eye < 0)) continue;
        const int change = met->along_normal ? side.surplus : -side.surplus;
        for (int i = 0; i < std::abs(change); ++i)
            found.push_back({met->depth, change > 0 ? 1 : -1, side.part, side.triangle,
                             side.plane.normal, side.number, side.flipped});
    }
    for (const Cap& cap : caps_) {
        if (!cap.is_met_by(line)) continue;
        const std::optional<Meeting> met = meet(cap.plane, line);
        if (!met) continue;
        const bool flipped = cap.triangle < flipped_.size() && flipped_[cap.triangle] != 0;
        found.push_back({met->depth, met->along_normal ? 1 : -1, Crossing::Part::light_cap,
                         cap.triangle, cap.plane.normal, 0, flipped});
    }
    if (ends_) cross_ends(line, found);
    std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
        if (a.depth != b.depth) return a.depth < b.depth;
        return std::tuple(!a.is_side() ? 0 : 1, a.change, a.triangle) <
               std::tuple(!b.is_side() ? 0 : 1, b.change, b.triangle);
    });
}

std::vector<SightPlane> RegionLedger::outlines(const std::array<glm::dvec3, 4>& corners) const {
    std::vector<SightPlane> planes;
    const auto add = [&](const SightPlane& plane) {
        if (Signs(corners, plane).mixed()) planes.push_back(plane);
    };
    for (std::size_t i = 0; i < vertices_.x.size(); ++i) add(vertices_.plane(i));
    for (const Silhouette::Side& side : sides_) add(side.edge);
    for (const Cap& cap : caps_)
        for (const SightPlane& edge : cap.edges) add(edge);
    if (!ends_) return planes;
    const std::vector<SightPlane> ends = ends_->outlines(corners);
    planes.insert(planes.end(), ends.begin(), ends.end());
    return planes;
}

// Parallel lines of sight all run to one point at infinity, which such a line meets nowhere or
// everywhere.
std::vector<SightPlane>
RegionLedger::vanishing_lines(const std::array<glm::dvec3, 4>& corners) const {
    std::vector<SightPlane> planes;
    for (const Silhouette::Side& side : sides_)
        if (const SightPlane line{side.plane.normal, 0};
            !is_parallel_ && Signs(corners, line).mixed())
            planes.push_back(line);
    return planes;
}

int RegionLedger::edge_on_sides(const std::array<glm::dvec3, 4>& corners) const {
    int edge_on = 0;
    const auto pass = [&](const SightPlane& one, const SightPlane& other) {
        return Signs(corners, one).mixed() && Signs(corners, other).mixed();
    };
    for (const Silhouette::Side& side : sides_) {
        const bool is_thin = is_parallel_ ? pass(vertices_.plane(side.p), vertices_.plane(side.q))
                                          : pass({side.plane.normal, 0}, side.edge);
        if (is_thin) edge_on += std::abs(side.surplus);
    }
    return edge_on;
}

std::vector<std::uint32_t> RegionLedger::light_caps() const {
    std::vector<std::uint32_t> triangles;
    for (const Cap& cap : caps_) triangles.push_back(cap.triangle);
    return triangles;
}

void RegionLedger::cross_ends(const glm::dvec3& line, std::vector<Crossing>& found) {
    ends_->crossings(line, found_at_ends_);
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
    std::erase_if(found, [&](const Crossing& crossing) {
        return crossing.is_side() && (crossing.depth < span_.least || crossing.depth > span_.most);
    });
}

} // namespace shadowproof
