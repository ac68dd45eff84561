#include "compare/traced/ray_cause.h"

#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

/// All triangles that a ray comes near, in no order.
class Collected final : public NearbyTriangles {
public:
    void visit(AnyRays& /*rays*/, std::uint32_t triangle, std::uint32_t /*lanes*/) override {
        triangles_.push_back(triangle);
    }
    std::vector<std::uint32_t> in_order() {
        std::ranges::sort(triangles_);
        return std::move(triangles_);
    }

private:
    std::vector<std::uint32_t> triangles_;
};

std::vector<std::uint32_t> nearby(const Tracer& tracer, const AnyRay& ray,
                                  double share = traversal_share) {
    AnyRays rays;
    rays.set(0, ray);
    Collected collected;
    find_nearby(tracer, share, rays, collected);
    return collected.in_order();
}

double place_on(const AnyRay& ray, const Corners& t) {
    const glm::dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    return glm::dot(t.a - ray.origin, normal) / glm::dot(ray.direction, normal);
}

std::uint32_t first_seen(const TracedClaim& claim, const AnyRay& ray) {
    std::uint32_t first = no_triangle;
    for (const std::uint32_t triangle : nearby(claim.tracer(), ray)) {
        const Corners t = corners(claim.scene(), triangle);
        if (claim.tables.visible[triangle] == 0 || !meets(ray, t) ||
            !stands_on_ray(claim.tracer(), ray, triangle))
            continue;
        const int order =
            first == no_triangle ? -1 : order_along(ray, t, corners(claim.scene(), first));
        if (order < 0 || (order == 0 && triangle < first)) first = triangle;
    }
    return first;
}

/// A triangle that truly stands between the point seen and the light. The point is computed in
/// double for finding candidates alone: its error is that of `depth` along the eye ray.
std::uint32_t true_occluder(const TracedClaim& claim, const AnyRay& eye_ray, std::uint32_t seen) {
    const Tracer& tracer = claim.tracer();
    const glm::dvec4 light = homogeneous(chosen_light(claim.scene()));
    const double depth = place_on(eye_ray, corners(claim.scene(), seen));
    AnyRay way;
    way.origin = eye_ray.origin + depth * eye_ray.direction;
    way.direction = glm::dvec3(light) - light.w * way.origin;
    if (light.w != 0) way.far = 1;
    const FloatMeeting met =
        float_meeting(eye_ray, corners(claim.scene(), seen), glm::dvec3(0, 0, 0));
    // Floats know the place to within t_error, and doubles much better; where even floats do not
    // know it at all, every triangle is a candidate.
    const bool is_known = met.meeting != Meeting::never && std::isfinite(met.t_error);
    for (const std::uint32_t triangle : nearby(tracer, way, is_known ? traversal_share : 1))
        if (stands_between(tracer, eye_ray, seen, triangle)) return triangle;
    return no_triangle;
}

bool share_a_corner(const Corners& t, const Corners& v) {
    for (const glm::dvec3& a : {t.a, t.b, t.c})
        for (const glm::dvec3& b : {v.a, v.b, v.c})
            if (a == b) return true;
    return false;
}

/// The exact hits of a shadow ray, nearest first.
std::vector<ExactHit> hits_of(const TracedClaim& claim, PixelPlace p, const AnyRay& ray) {
    std::vector<ExactHit> hits;
    for (const std::uint32_t triangle : nearby(claim.tracer(), ray)) {
        const Corners t = corners(claim.scene(), triangle);
        if (claim.may_stop(p, triangle) && meets(ray, t) &&
            stands_on_ray(claim.tracer(), ray, triangle))
            hits.push_back({triangle, place_on(ray, t)});
    }
    std::ranges::stable_sort(hits, {}, &ExactHit::t);
    return hits;
}

/// Where the ray leaves through the receiver's plane, if it starts behind it.
std::optional<double> leaving_place(const TracedClaim& claim, PixelPlace p, const AnyRay& ray) {
    AnyRay line = ray;
    line.near = 0;
    const double t = place_on(line, corners(claim.scene(), claim.pixel(p).seen));
    if (!(t > 0) || !(t < ray.far)) return std::nullopt;
    return t;
}

/// Whether a triangle lies in the receiver's plane as nearly as floats have coplanar corners.
/// Rounded are the corner, by v of its coordinates, and the plane at it: there a corner of the
/// receiver counts as much as it weighs.
bool is_coplanar(const Corners& receiver, const Corners& t) {
    const glm::dvec3 ab = receiver.b - receiver.a;
    const glm::dvec3 ac = receiver.c - receiver.a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double squared = glm::dot(normal, normal);
    const auto rounded = [&](const glm::dvec3& corner) {
        return float_roundoff * glm::dot(glm::abs(normal), glm::abs(corner));
    };
    const auto lies_within = [&](const glm::dvec3& corner) {
        const glm::dvec3 way = corner - receiver.a;
        const double of_b = glm::dot(glm::cross(way, ac), normal) / squared;
        const double of_c = glm::dot(glm::cross(ab, way), normal) / squared;
        const double error = rounded(corner) + std::abs(1 - of_b - of_c) * rounded(receiver.a) +
                             std::abs(of_b) * rounded(receiver.b) +
                             std::abs(of_c) * rounded(receiver.c);
        return std::abs(glm::dot(way, normal)) <= error;
    };
    return lies_within(t.a) && lies_within(t.b) && lies_within(t.c);
}

/// A ray that starts below a surface meets it from within: at its plane, or before, where the
/// surface is bent away from the light.
void mark_own_surface(const TracedClaim& claim, PixelPlace p, const std::optional<double>& leaves,
                      std::vector<ExactHit>& hits) {
    const Corners receiver = corners(claim.scene(), claim.pixel(p).seen);
    for (ExactHit& hit : hits) {
        const Corners t = corners(claim.scene(), hit.triangle);
        hit.is_own = hit.triangle == claim.pixel(p).seen || share_a_corner(t, receiver) ||
                     (leaves && (hit.t <= *leaves || is_coplanar(receiver, t)));
    }
}

/// The shadow ray as it would have been without epsilon or offset.
AnyRay unbiased(const TracedClaim& claim, PixelPlace p) {
    return as_exact(expected_shadow_ray(claim, p, 0));
}

std::optional<ExactHit> find_passed_over(const TracedClaim& claim, PixelPlace p) {
    if (claim.rays().model.start == RayModel::Start::skip) return std::nullopt;
    const AnyRay ray = unbiased(claim, p);
    if (ray.direction == glm::dvec3(0, 0, 0)) return std::nullopt;
    for (const ExactHit& hit : hits_of(claim, p, ray))
        if (stands_between(claim.tracer(), claim.eye_ray(p), claim.pixel(p).seen, hit.triangle))
            return hit;
    return std::nullopt;
}

} // namespace

ExactRays trace_exactly(const TracedClaim& claim, PixelPlace p) {
    const Tracer& tracer = claim.tracer();
    const TracedPixel& pixel = claim.pixel(p);
    const AnyRay eye_ray = claim.eye_ray(p);
    ExactRays exact;
    exact.seen = first_seen(claim, eye_ray);
    if (pixel.seen == no_triangle) return exact;
    exact.there = Visibility::shadowed;
    if (faces_light(tracer, pixel.seen) && within_cone(tracer, eye_ray, pixel.seen)) {
        if (receives_shadows(tracer, pixel.seen))
            exact.between = true_occluder(claim, eye_ray, pixel.seen);
        if (exact.between == no_triangle) exact.there = Visibility::lit;
    }
    if (!pixel.shot) return exact;
    const AnyRay ray = claim.shadow_ray(p);
    exact.leaves_at = leaving_place(claim, p, ray);
    exact.hits = hits_of(claim, p, ray);
    mark_own_surface(claim, p, exact.leaves_at, exact.hits);
    if (exact.there == Visibility::shadowed && exact.hits.empty())
        exact.passed_over = find_passed_over(claim, p);
    return exact;
}

namespace {

/// The truth where an eye ray meets a triangle.
Visibility truth_at(const TracedClaim& claim, const AnyRay& eye_ray, std::uint32_t seen) {
    const Tracer& tracer = claim.tracer();
    if (seen == no_triangle) return Visibility::background;
    if (!faces_light(tracer, seen) || !within_cone(tracer, eye_ray, seen))
        return Visibility::shadowed;
    if (!receives_shadows(tracer, seen)) return Visibility::lit;
    return true_occluder(claim, eye_ray, seen) == no_triangle ? Visibility::lit
                                                              : Visibility::shadowed;
}

/// Whether a ray without offset would have met nothing but the receiver's own surface.
bool offset_went_astray(const TracedClaim& claim, PixelPlace p) {
    if (claim.rays().model.start != RayModel::Start::offset) return false;
    const AnyRay ray = unbiased(claim, p);
    std::vector<ExactHit> hits = hits_of(claim, p, ray);
    mark_own_surface(claim, p, leaving_place(claim, p, ray), hits);
    return std::ranges::all_of(hits, &ExactHit::is_own);
}

/// Of a shadow ray whose exact answer is not the truth at the point that was seen.
PixelCause cause_of_shadow_ray(const TracedClaim& claim, PixelPlace p, const ExactRays& exact) {
    if (exact.there == Visibility::shadowed)
        return {exact.passed_over ? Cause::leak : Cause::precision, {}};
    const bool some_own = std::ranges::any_of(exact.hits, &ExactHit::is_own);
    if (some_own && std::ranges::all_of(exact.hits, &ExactHit::is_own)) return {Cause::acne, {}};
    if (offset_went_astray(claim, p)) return {Cause::leak, {}};
    if (!some_own) return {Cause::precision, {}};
    PixelCause both{Cause::acne, {}};
    both.also.add(Cause::precision);
    return both;
}

} // namespace

PixelCause cause_of_rays(const TracedClaim& claim, PixelPlace p) {
    const Visibility truth = claim.traced.truth().visibility.at(p.x, p.y);
    const Visibility claimed = claim.frame.claim.at(p.x, p.y);
    const TracedPixel& pixel = claim.pixel(p);
    const ExactRays exact = trace_exactly(claim, p);
    Visibility answered = claimed;
    if (pixel.shot) answered = exact.hits.empty() ? Visibility::lit : Visibility::shadowed;
    if (answered != claimed && answered == truth) return {Cause::missed, {}};
    if (exact.there == truth) return cause_of_shadow_ray(claim, p, exact);
    if (exact.seen != pixel.seen && truth_at(claim, claim.eye_ray(p), exact.seen) == truth)
        return {Cause::missed, {}};
    return {Cause::precision, {}};
}

} // namespace shadowproof
