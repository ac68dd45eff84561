#include "reference/trace/any_rays.h"

#include "reference/exact/norms.h"
#include "reference/trace/lanes.h"
#include "reference/trace/state.h"
#include "reference/walk/walk_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

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
glm::dvec3 reach_of(const Clusters& clusters) {
    return glm::max(glm::abs(glm::dvec3(clusters.box.lower)),
                    glm::abs(glm::dvec3(clusters.box.upper)));
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
    return enlargement_of(reach_of(tracer.state().clusters), share, origin);
}

namespace {

/// The rays as the walk has them, and back.
struct Walked {
    WalkLines lines;
    Lanes<double> stretch{}; ///< s over t
    Lanes<double> start{};   ///< s at which the walk's ray begins
    double room = 0;         ///< how far rays may be from the walk's
};

/// Components below least_component may be anything up to it; at s, which is at most |p| + 2 in
/// the scene's box, that weighs as much, and so does rounding.
void set_line(Walked& walked, int lane, const AnyRay& ray, const WalkFrame& frame,
              const glm::dvec3& enlargement) {
    const auto l = static_cast<std::size_t>(lane);
    const glm::dvec3 p = (ray.origin - frame.center) * frame.scale;
    const glm::dvec3 d = ray.direction * frame.scale;
    const double size = largest(d);
    // A sum is no number where a component is none.
    const bool known = size > 0x1p-1000 && sum_of(d) < 0x1p1000 && sum_of(p) < 0x1p1000;
    const double stretch = known ? std::exp2(std::ilogb(size)) : 1;
    double error = 0x1p-50;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        walked.lines.p.axis[k][l] = known ? p[axis] : 0;
        walked.lines.w.axis[k][l] = known ? d[axis] / stretch : 1;
        if (std::abs(ray.direction[axis]) < least_component)
            error = std::max(error, 0x1p-50 + 2 * least_component * frame.scale / stretch);
    }
    walked.stretch[l] = stretch;
    const auto moved = [&](double t, double by) {
        return t * stretch + by * (1 + std::abs(t * stretch));
    };
    walked.lines.begin[l] = moved(ray.near, -0x1p-20);
    walked.lines.end[l] = moved(ray.far, 0x1p-20);
    const double room = largest(enlargement) * frame.scale + (largest(p) + 2) * error;
    walked.room = std::max(walked.room, known ? room : std::numeric_limits<double>::infinity());
}

/// A search for nearby triangles under way.
struct NearbySearch {
    const Clusters& clusters;
    const Places& places;
    const Slabs& slabs;
    const Walked& walked;
    AnyRays& rays;
    NearbyTriangles& found;

    void meet(std::uint32_t number, std::uint32_t asked) const {
        const std::uint32_t lanes = lanes_near(rays, slabs, clusters.boxes[number]) & asked;
        if (lanes == 0) return;
        for (const std::uint32_t first : clusters.all[number].triangles) {
            if (first == no_triangle) return;
            for (std::uint32_t i = first; i != no_triangle && (lanes & rays.lanes) != 0;
                 i = places.next[i])
                found.visit(rays, i, lanes & rays.lanes);
        }
    }

    static void visit(void* visitor, std::uint32_t cluster, int first, int count, float* far) {
        const auto& search = *static_cast<const NearbySearch*>(visitor);
        search.meet(cluster, ((1U << count) - 1) << first);
        for (int i = 0; i < count; ++i) {
            const auto l = static_cast<std::size_t>(first + i);
            const bool goes_on = (search.rays.lanes >> l & 1U) != 0;
            const double s =
                goes_on ? search.rays.far[l] * search.walked.stretch[l] - search.walked.start[l]
                        : 0;
            const auto limit = static_cast<float>(std::max(s, 0.0)) * (1 + 0x1p-20F) + 0x1p-20F;
            if (limit < far[i]) far[i] = limit;
        }
    }
};

} // namespace

void find_nearby(const Tracer& tracer, double share, AnyRays& rays, NearbyTriangles& found) {
    if (rays.lanes == 0) return;
    const Clusters& clusters = tracer.state().clusters;
    const BoxTrees& trees = *tracer.state().trees;
    const glm::dvec3 reach = reach_of(clusters);
    const Slabs slabs = slabs_of(rays, reach, share);
    Walked walked;
    for (std::uint32_t left = rays.lanes; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const AnyRay ray = rays.ray(lane);
        set_line(walked, lane, ray, trees.frame(), enlargement_of(reach, share, ray.origin));
    }
    NearbySearch search{clusters, tracer.state().places, slabs, walked, rays, found};
    if (const BoxTree* tree = trees.with_room(walked.room)) {
        WalkRays walk;
        walk.lanes = rays.lanes;
        cut_to_scene(walked.lines, walk, walked.start);
        tree->find_all(walk, NearbySearch::visit, &search);
    } else {
        for (std::uint32_t i = 0; i < clusters.all.size() && rays.lanes != 0; ++i)
            search.meet(i, rays.lanes);
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

bool stands_on_ray(const Tracer& tracer, const AnyRay& given, std::uint32_t triangle) {
    const Tracer::State& state = tracer.state();
    return !state.has_mask(triangle) ||
           mask_on_ray(Filters::on, exact_ray(given, {}), state.masked(triangle)).sign >= 0;
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
           holds(predicates.shadow_edge(ray, q, t.c, t.a)) &&
           (!state.has_mask(triangle) ||
            mask_before_light(Filters::on, ray, q, state.masked(triangle)).sign >= 0);
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
