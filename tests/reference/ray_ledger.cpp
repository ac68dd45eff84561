#include "tests/reference/ray_ledger.h"

#include "reference/exact/norms.h"
#include "reference/predict/ledger.h"
#include "reference/trace/faces.h"
#include "reference/trace/state.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

namespace shadowproof {

namespace {

/// A linear function of space and the interval that its values must meet.
struct Slab {
    glm::dvec3 gradient{0, 0, 0};
    double lower = 0; ///< of gradient . (X - O)
    double upper = 0;
};

/// The part of the plane through eye ray and light that holds what may cross the lines from the
/// ray's points to the light: X - O = p e + q D with 0 <= q. Towards a point light O = L, e = E - L
/// and 0 <= p <= 1; towards a directional one O = E, e = l and 0 <= p. With m = e x D, m . (X - O)
/// = 0, (D x m) . (X - O) = p m.m, (m x e) . (X - O) = q m.m.
struct Region {
    glm::dvec3 origin{0, 0, 0};
    std::array<Slab, 3> slabs{};
};

/// `reach`: at least the size of a component of X - O for all X of the scene. Rays next to D by
/// `radius` move X by at most q radius a component.
Region swept_region(const Tracer::State& state, const glm::dvec3& direction, double radius) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool directional = state.light.w == 0;
    const glm::dvec3 light(state.light);
    const glm::dvec3 e = directional ? light : state.scene->camera.eye - light;
    const glm::dvec3 m = glm::cross(e, direction);
    const double mm = glm::dot(m, m);
    const double reach = 1 / (directional ? state.from_eye : state.from_light).scale;
    // Towards a point q |D| <= |X - L| + |e|, largest components. Else |q m| = |(X - E) x e| <=
    // 2 sum |e| reach, and for a ray next to D, m is shorter by up to 2 |e| radius.
    const double steepness = largest(m) - 2 * largest(e) * radius;
    const double farthest = directional
                                ? (steepness > 0 ? 2 * sum_of(e) * reach / steepness : infinity)
                                : (reach + largest(e)) / largest(direction);
    const double extent = directional ? reach : reach + largest(e);
    // Gradients are products of up to four factors, each off by some 2^-53: 2^-40 of the terms'
    // sizes, before anything cancels, leaves room for thousands of roundings.
    const auto slab = [&](const glm::dvec3& gradient, double terms, double upper) {
        double margin = 0x1p-40 * terms * extent;
        if (radius > 0)
            margin += std::isinf(farthest) ? infinity : sum_of(gradient) * farthest * radius;
        return Slab{gradient, -margin, upper + margin};
    };
    const double terms = 6 * largest(e) * largest(direction);
    return {directional ? state.scene->camera.eye : light,
            {slab(m, 3 * terms, 0),
             slab(glm::cross(direction, m), 18 * largest(direction) * terms,
                  directional ? infinity : mm),
             slab(glm::cross(m, e), 18 * largest(e) * terms, infinity)}};
}

bool may_meet(const Box& box, const Region& region) {
    const glm::dvec3 lower(box.lower);
    const glm::dvec3 upper(box.upper);
    const glm::dvec3 centre = 0.5 * (lower + upper) - region.origin;
    const glm::dvec3 half = 0.5 * (upper - lower);
    return std::all_of(region.slabs.begin(), region.slabs.end(), [&](const Slab& slab) {
        const double middle = glm::dot(slab.gradient, centre);
        const double extent = glm::dot(glm::abs(slab.gradient), half);
        return middle - extent <= slab.upper && middle + extent >= slab.lower;
    });
}

/// A face of one triangle's shadow volume.
struct Face {
    glm::dvec3 plane{0, 0, 0};
    Crossing::Part part = Crossing::Part::light_cap;
};

/// The stretch of an eye ray that lies in one triangle's shadow volume, which is convex.
struct Stretch {
    double begin = -std::numeric_limits<double>::infinity();
    double end = std::numeric_limits<double>::infinity();
    Face first; ///< where it begins
    Face last;  ///< where it ends

    /// `eye`: the depth at which lines of sight begin.
    bool is_ahead(double eye) const { return begin < end && end > eye; }

    /// Keeps what has constant + t slope >= 0.
    void cut(double constant, double slope, const Face& face) {
        if (slope == 0) {
            if (constant < 0) end = begin;
            return;
        }
        const double t = -constant / slope;
        if (slope > 0 && t > begin) {
            begin = t;
            first = face;
        } else if (slope < 0 && t < end) {
            end = t;
            last = face;
        }
    }
};

double depth_of_eye(const Camera& camera) {
    return camera.is_orthographic() ? -std::numeric_limits<double>::infinity() : 0;
}

/// `radius` widens the stretch to hold those of all rays whose direction differs by at most that a
/// component: a plane's slope then differs by at most |plane|_1 radius.
Stretch stretch_in_volume(const Tracer::State& state, const Corners& t, const glm::dvec3& line,
                          double radius) {
    Stretch stretch;
    const glm::dvec3& start = start_of(state.scene->camera, line);
    const glm::dvec3& direction = direction_of(state.scene->camera, line);
    const auto slope = [&](const glm::dvec3& plane) {
        return glm::dot(direction, plane) + radius * sum_of(plane);
    };
    // The light sees the front: from it a, c, b is the positive order.
    const std::array<std::pair<const glm::dvec3*, const glm::dvec3*>, 3> edges{
        {{&t.b, &t.a}, {&t.c, &t.b}, {&t.a, &t.c}}};
    for (std::size_t part = 0; part < edges.size(); ++part) {
        const auto [a, b] = edges[part];
        const glm::dvec3 plane = side_plane(state.light, *a, *b);
        stretch.cut(glm::dot(start - side_point(state.light, *a, *b), plane), slope(plane),
                    {plane, static_cast<Crossing::Part>(part)});
    }
    const glm::dvec3 away = cap_plane(t);
    stretch.cut(glm::dot(start - t.a, away), slope(away), {away, Crossing::Part::light_cap});
    return stretch;
}

/// Adds up sides at one depth; what remains is a side of the union with multiplicity.
std::vector<Crossing> cancel_shared_sides(std::vector<Crossing> events) {
    std::sort(events.begin(), events.end(), [](const Crossing& a, const Crossing& b) {
        if (a.depth != b.depth) return a.depth < b.depth;
        if (a.is_side() != b.is_side()) return b.is_side();
        if (a.change != b.change) return a.change < b.change;
        return a.triangle < b.triangle;
    });
    std::vector<Crossing> kept;
    for (std::size_t i = 0; i < events.size();) {
        std::size_t end = i;
        int sides = 0;
        for (; end < events.size() && events[end].depth == events[i].depth; ++end) {
            if (events[end].is_side())
                sides += events[end].change;
            else
                kept.push_back(events[end]);
        }
        const int change = sides > 0 ? 1 : -1;
        for (std::size_t k = i; k < end && sides != 0; ++k) {
            if (!events[k].is_side() || events[k].change != change) continue;
            kept.push_back(events[k]);
            sides -= change;
        }
        i = end;
    }
    return kept;
}

} // namespace

NearbyVolumes volumes_near(const Tracer& tracer, const glm::dvec3& line, double radius) {
    const Tracer::State& state = tracer.state();
    const Camera& camera = state.scene->camera;
    const Region region = camera.is_orthographic() ? Region{} : swept_region(state, line, radius);
    NearbyVolumes volumes;
    state.clusters.for_each_in(
        [&](const Box& box) { return camera.is_orthographic() || may_meet(box, region); },
        [&](const Cluster& cluster) {
            for (const std::uint32_t triangle : cluster.triangles) {
                if (triangle == no_triangle || state.from_light.side[triangle] >= 0) continue;
                // A little more than the radius, for the rounding of the slopes.
                const Stretch stretch = stretch_in_volume(state, corners(*state.scene, triangle),
                                                          line, radius * (1 + 0x1p-20));
                if (stretch.is_ahead(depth_of_eye(camera))) volumes.triangles.push_back(triangle);
            }
        });
    std::sort(volumes.triangles.begin(), volumes.triangles.end());
    return volumes;
}

RayLedger ray_ledger(const Tracer& tracer, const NearbyVolumes& volumes, const glm::dvec3& line) {
    const Tracer::State& state = tracer.state();
    const double eye = depth_of_eye(state.scene->camera);
    RayLedger ledger;
    std::vector<Crossing> events;
    for (const std::uint32_t triangle : volumes.triangles) {
        const Stretch stretch = stretch_in_volume(state, corners(*state.scene, triangle), line, 0);
        if (!stretch.is_ahead(eye)) continue;
        const auto event = [&](double depth, int change, const Face& face) {
            events.push_back({depth, change, face.part, triangle, face.plane});
        };
        if (stretch.begin <= eye)
            ++ledger.at_eye;
        else
            event(stretch.begin, 1, stretch.first);
        if (std::isinf(stretch.end))
            ++ledger.at_infinity;
        else
            event(stretch.end, -1, stretch.last);
    }
    ledger.crossings = cancel_shared_sides(std::move(events));
    return ledger;
}

RayLedger ray_ledger(const Tracer& tracer, const glm::dvec3& line) {
    return ray_ledger(tracer, volumes_near(tracer, line, 0), line);
}

} // namespace shadowproof
