#include "reference/trace/any_rays.h"

#include "reference/exact/norms.h"
#include "reference/trace/lanes.h"
#include "reference/trace/state.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

void AnyRays::set(int lane, const AnyRay& ray) {
    const auto l = static_cast<std::size_t>(lane);
    for (int axis = 0; axis < 3; ++axis) {
        origin[static_cast<std::size_t>(axis)][l] = ray.origin[axis];
        direction[static_cast<std::size_t>(axis)][l] = ray.direction[axis];
    }
    near[l] = ray.near;
    far[l] = ray.far;
    lanes |= 1U << l;
}

AnyRay AnyRays::ray(int lane) const {
    const auto l = static_cast<std::size_t>(lane);
    return {{origin[0][l], origin[1][l], origin[2][l]},
            {direction[0][l], direction[1][l], direction[2][l]},
            near[l],
            far[l]};
}

namespace {

/// The largest coordinate on each axis.
glm::dvec3 reach_of(const Hierarchy& hierarchy) {
    const Entry& root = hierarchy.entries.front();
    glm::dvec3 reach{0, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis)
        reach[static_cast<int>(axis)] =
            std::max(std::abs(double{root.lower[axis]}), std::abs(double{root.upper[axis]}));
    return reach;
}

glm::dvec3 enlargement_of(const glm::dvec3& reach, double share, const glm::dvec3& origin) {
    const glm::dvec3 sizes = glm::abs(origin) + reach;
    return share * (sizes + 0x1p-32 * largest(sizes));
}

Slabs slabs_of(const AnyRays& rays, const glm::dvec3& reach, double share) {
    Slabs slabs;
    for (std::uint32_t left = rays.lanes; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const AnyRay ray = rays.ray(lane);
        set_slabs(slabs, lane, ray, enlargement_of(reach, share, ray.origin));
    }
    return slabs;
}

} // namespace

glm::dvec3 enlargement(const Tracer& tracer, double share, const glm::dvec3& origin) {
    return enlargement_of(reach_of(tracer.state().hierarchy), share, origin);
}

void find_nearby(const Tracer& tracer, double share, AnyRays& rays, NearbyTriangles& found) {
    if (rays.lanes == 0) return;
    const Hierarchy& hierarchy = tracer.state().hierarchy;
    const Places& places = tracer.state().places;
    const Slabs slabs = slabs_of(rays, reach_of(hierarchy), share);
    const AnyRay first = rays.ray(__builtin_ctz(rays.lanes));
    const auto along = [&](const Entry& box) {
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum += (double{box.lower[axis]} + box.upper[axis]) *
                   first.direction[static_cast<int>(axis)];
        return sum;
    };
    // Two children an entry: one waits on each level.
    std::array<std::uint32_t, 2 * deepest_level> waiting{};
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0 && rays.lanes != 0) {
        const Entry& entry = hierarchy.entries[waiting[--count]];
        const std::uint32_t lanes = lanes_near(rays, slabs, entry);
        if (lanes == 0) continue;
        if (entry.count > 0) {
            for (std::uint32_t i = 0; i < entry.count; ++i) waiting[count++] = entry.first + i;
            // What is near may lower the rays' limits: the farther one waits longer.
            if (entry.count == 2 && along(hierarchy.entries[waiting[count - 1]]) >
                                        along(hierarchy.entries[waiting[count - 2]]))
                std::swap(waiting[count - 1], waiting[count - 2]);
            continue;
        }
        const Cluster& cluster = hierarchy.clusters[entry.first];
        for (std::uint32_t i = 0; i < cluster.count && (lanes & rays.lanes) != 0; ++i)
            for (std::uint32_t triangle = cluster.triangles[i]; triangle != no_triangle;
                 triangle = places.next[triangle])
                found.visit(rays, triangle, lanes & rays.lanes);
    }
}

namespace {

EyeRay exact_ray(const AnyRay& ray, const glm::dvec4& light) {
    return {ray.origin, ray.direction, light};
}

RayPoint surface_point(const Tracer& tracer, std::uint32_t seen) {
    return {.kind = RayPoint::Kind::surface, .surface = corners(tracer.scene(), seen)};
}

} // namespace

// The edges' planes of an oriented triangle add up to its normal: if the ray passes all on one
// side, it runs that way through the triangle. A ray in the plane has three signs of zero.
bool meets(const AnyRay& given, const Corners& t) {
    const EyeRay ray = exact_ray(given, {});
    const Predicates predicates;
    const int signs[]{predicates.edge(ray, t.a, t.b).sign, predicates.edge(ray, t.b, t.c).sign,
                      predicates.edge(ray, t.c, t.a).sign};
    const bool some_above = std::ranges::any_of(signs, [](int sign) { return sign > 0; });
    const bool some_below = std::ranges::any_of(signs, [](int sign) { return sign < 0; });
    return some_above != some_below && meets_plane(given, t);
}

bool meets_plane(const AnyRay& given, const Corners& t) {
    const EyeRay ray = exact_ray(given, {});
    const Predicates predicates;
    const bool is_beyond_near = (std::isinf(given.near) && given.near < 0) ||
                                predicates.depth_against(ray, t, given.near).sign > 0;
    return is_beyond_near &&
           (std::isinf(given.far) || predicates.depth_against(ray, t, given.far).sign <= 0);
}

int order_along(const AnyRay& ray, const Corners& t, const Corners& u) {
    return Predicates{}.depth_order(exact_ray(ray, {}), t, u).sign;
}

bool stands_between(const Tracer& tracer, const AnyRay& given, std::uint32_t seen,
                    std::uint32_t triangle) {
    const Tracer::State& state = tracer.state();
    const int orientation = state.from_light.side[triangle];
    if (orientation == 0 || triangle == seen) return false;
    const EyeRay ray = exact_ray(given, state.light);
    const RayPoint q = surface_point(tracer, seen);
    const Corners t = corners(*state.scene, triangle);
    const Predicates& predicates = state.predicates;
    const auto holds = [&](const Decision& decision) { return decision.sign * orientation >= 0; };
    const Decision beyond = predicates.side_of_point(ray, q, t);
    return beyond.sign * orientation > 0 && holds(predicates.shadow_edge(ray, q, t.a, t.b)) &&
           holds(predicates.shadow_edge(ray, q, t.b, t.c)) &&
           holds(predicates.shadow_edge(ray, q, t.c, t.a));
}

bool within_cone(const Tracer& tracer, const AnyRay& ray, std::uint32_t seen) {
    const Tracer::State& state = tracer.state();
    if (!state.cone) return true;
    return state.predicates
               .within_cone(exact_ray(ray, state.light), surface_point(tracer, seen), *state.cone)
               .sign >= 0;
}

bool faces_light(const Tracer& tracer, std::uint32_t triangle) {
    return tracer.state().faces_light(triangle);
}
bool receives_shadows(const Tracer& tracer, std::uint32_t triangle) {
    return tracer.state().receives[triangle] != 0;
}

} // namespace shadowproof
