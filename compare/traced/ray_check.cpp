#include "compare/traced/ray_check.h"

#include "scenes/camera.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

RayTables::RayTables(const Tracer& tracer) : casts(casting_triangles(tracer.scene())) {
    for (std::uint32_t i = 0; i < tracer.scene().triangles.size(); ++i)
        visible.push_back(sides_of(tracer, i).visible ? 1 : 0);
}

AnyRay as_exact(const FloatRay& ray) {
    return {ray.origin, ray.direction, ray.near, ray.far};
}

AnyRay TracedClaim::eye_ray(PixelPlace p) const {
    return as_exact(rays().eye_ray(pixel(p).line));
}

AnyRay TracedClaim::shadow_ray(PixelPlace p) const {
    return as_exact(pixel(p).shadow);
}

glm::vec3 rounded_hit(const TracedClaim& claim, PixelPlace p) {
    const TracedPixel& pixel = claim.pixel(p);
    const FloatRay ray = claim.rays().eye_ray(pixel.line);
    glm::vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        const float along = pixel.depth * ray.direction[axis];
        point[axis] = ray.origin[axis] + along;
    }
    return point;
}

namespace {

/// Rounded once from double, as the light sees the triangle.
glm::vec3 normal_towards_light(const TracedClaim& claim, std::uint32_t triangle) {
    const Corners t = corners(claim.scene(), triangle);
    const glm::dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    const double turn = sides_of(claim.tracer(), triangle).back_to_light ? -1 : 1;
    return normal * (turn / glm::length(normal));
}

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Embree takes no larger origin.
bool can_be_shot(const FloatRay& ray) {
    constexpr float largest_origin = 1.844e18F;
    const glm::vec3 size = glm::abs(ray.origin);
    return is_finite(ray.origin) && is_finite(ray.direction) &&
           std::max({size.x, size.y, size.z}) < largest_origin &&
           ray.direction != glm::vec3(0, 0, 0) && ray.far > ray.near;
}

} // namespace

FloatRay expected_shadow_ray(const TracedClaim& claim, PixelPlace p, float distance) {
    const RayModel::Start start = claim.rays().model.start;
    const Light& light = chosen_light(claim.scene());
    FloatRay ray;
    ray.origin = rounded_hit(claim, p);
    if (start == RayModel::Start::epsilon) ray.near = distance;
    if (start == RayModel::Start::offset) {
        const glm::vec3 normal = normal_towards_light(claim, claim.pixel(p).seen);
        for (int axis = 0; axis < 3; ++axis) {
            const float along = distance * normal[axis];
            ray.origin[axis] += along;
        }
    }
    if (light.kind == Light::Kind::directional) {
        ray.direction = glm::vec3(-light.direction);
        return ray;
    }
    const glm::vec3 way = glm::vec3(light.position) - ray.origin;
    const float length = std::sqrt((way.x * way.x + way.y * way.y) + way.z * way.z);
    if (!(length > 0) || !std::isfinite(length)) return ray;
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = way[axis] / length;
    ray.far = length;
    return ray;
}

RayFault fault_of_all(const TracedClaim& claim) {
    const Camera& camera = claim.scene().camera;
    const TracedRays& rays = claim.rays();
    if (rays.is_parallel != camera.is_orthographic()) return "projection is not the camera's";
    if (rays.is_parallel ? rays.forward != glm::vec3(camera.forward)
                         : rays.eye != glm::vec3(camera.eye))
        return rays.is_parallel ? "view direction is not the camera's" : "eye is not the camera's";
    if (rays.near != static_cast<float>(camera.near) || rays.far != static_cast<float>(camera.far))
        return "eye ray has other limits than the camera";
    if (!(rays.model.distance >= 0) || !std::isfinite(rays.model.distance))
        return "epsilon is negative or no number";
    if (rays.pixels.width != camera.width || rays.pixels.height != camera.height)
        return "rays are of another picture size";
    return {};
}

RayTile tile_at(const Frame& frame, int left, int top) {
    RayTile tile;
    for (int i = 0; i < packet_size; ++i) {
        const PixelPlace p{left + i % ray_tile, top + i / ray_tile};
        tile.places[static_cast<std::size_t>(i)] = p;
        if (p.x < frame.claim.width && p.y < frame.claim.height) tile.lanes |= 1U << i;
    }
    return tile;
}

namespace {

template <class Work>
void for_lanes(std::uint32_t lanes, const Work& work) {
    for (std::uint32_t left = lanes; left != 0; left &= left - 1) work(__builtin_ctz(left));
}

/// Finds, for each ray, a triangle that it certainly meets.
class CertainMeetings final : public NearbyTriangles {
public:
    CertainMeetings(const TracedClaim& claim, const RayTile& tile, bool eye_rays)
        : claim_(claim), tile_(tile), eye_rays_(eye_rays) {}

    void set(AnyRays& rays, int lane, const AnyRay& ray) {
        rays.set(lane, ray);
        enlargement_[static_cast<std::size_t>(lane)] =
            enlargement(claim_.tracer(), traversal_share, ray.origin);
    }
    void visit(AnyRays& rays, std::uint32_t triangle, std::uint32_t lanes) override {
        if (eye_rays_ && claim_.tables.visible[triangle] == 0) return;
        for_lanes(lanes, [&](int lane) {
            const auto l = static_cast<std::size_t>(lane);
            if (!eye_rays_ && !claim_.may_stop(tile_.places[l], triangle)) return;
            if (float_meeting(claim_.tracer(), rays.ray(lane), triangle, enlargement_[l]).meeting !=
                Meeting::always)
                return;
            met_ |= 1U << lane;
            rays.lanes &= ~(1U << lane);
        });
    }
    bool met(int lane) const { return (met_ >> lane & 1U) != 0; }

private:
    const TracedClaim& claim_;
    const RayTile& tile_;
    bool eye_rays_;
    std::uint32_t met_ = 0;
    std::array<glm::dvec3, packet_size> enlargement_{};
};

FloatMeeting meeting_of(const TracedClaim& claim, const AnyRay& ray, std::uint32_t triangle) {
    return float_meeting(claim.tracer(), ray, triangle,
                         enlargement(claim.tracer(), traversal_share, ray.origin));
}

/// The triangle that is seen may be met, and there.
RayFault fault_of_seen(const TracedClaim& claim, PixelPlace p) {
    const TracedPixel& pixel = claim.pixel(p);
    if (pixel.seen == no_triangle) return {};
    if (pixel.seen >= claim.scene().triangles.size() || claim.tables.visible[pixel.seen] == 0)
        return "eye ray met a triangle that is not seen from the eye";
    const FloatMeeting met = meeting_of(claim, claim.eye_ray(p), pixel.seen);
    if (met.meeting == Meeting::never) return "eye ray does not meet the triangle seen";
    // Embree asks whether near |den| is less than T, which rounds once, and makes t of T by a
    // reciprocal, with 8 roundings at most: 10 are more than both. Negated: infinity is no error
    // bound that anything exceeds.
    const double near = claim.rays().near * (1 - 10 * float_roundoff);
    if (std::abs(pixel.depth - met.t) > met.t_error || !(pixel.depth >= near))
        return "eye ray meets the triangle seen elsewhere";
    return {};
}

/// Whether the rounded point is in the light's cone, where doubles tell.
Meeting in_cone(const TracedClaim& claim, PixelPlace p) {
    const Light& light = chosen_light(claim.scene());
    if (light.kind != Light::Kind::spot) return Meeting::always;
    const glm::dvec3 point = rounded_hit(claim, p);
    const glm::dvec3 from_light = point - light.position;
    const double inside = glm::dot(from_light, light.direction) -
                          std::cos(light.outer_cone) * glm::length(from_light);
    // A dozen roundings of numbers no larger than this; 2^-53 each.
    const double error = 0x1p-48 * (glm::length(point) + glm::length(light.position));
    return inside > error ? Meeting::always : (inside < -error ? Meeting::never : Meeting::perhaps);
}

bool same(const FloatRay& a, const FloatRay& b) {
    return a.origin == b.origin && a.direction == b.direction && a.near == b.near && a.far == b.far;
}

/// Of a pixel whose surface faces the light and receives shadows.
RayFault fault_of_shadow_ray(const TracedClaim& claim, PixelPlace p) {
    const TracedPixel& pixel = claim.pixel(p);
    const FloatRay expected = expected_shadow_ray(claim, p, claim.rays().model.distance);
    if (pixel.shot != can_be_shot(expected))
        return pixel.shot ? "shadow ray cannot have been shot" : "shadow ray was not shot";
    if (!pixel.shot) return {};
    if (!same(pixel.shadow, expected)) return "shadow ray is not the one that the technique shoots";
    if (pixel.occluder == no_triangle) return {};
    if (pixel.occluder >= claim.scene().triangles.size() || !claim.may_stop(p, pixel.occluder))
        return "shadow ray met a triangle that cannot stop it";
    if (meeting_of(claim, claim.shadow_ray(p), pixel.occluder).meeting == Meeting::never)
        return "shadow ray does not meet the triangle that it is said to";
    return {};
}

/// Whether ray, answer and claim belong together, but for triangles that the rays ought to have
/// met.
RayFault fault_at(const TracedClaim& claim, PixelPlace p) {
    const TracedPixel& pixel = claim.pixel(p);
    const Visibility claimed = claim.frame.claim.at(p.x, p.y);
    if (pixel.line != glm::vec3(line_of_sight(claim.scene().camera, p.x + 0.5, p.y + 0.5)))
        return "eye ray is not that of the pixel";
    if (const RayFault fault = fault_of_seen(claim, p); !fault.empty()) return fault;
    constexpr RayFault contradicted = "claim does not follow from what its rays met";
    if (pixel.seen == no_triangle)
        return claimed == Visibility::background && !pixel.shot ? RayFault{} : contradicted;
    const bool may_be_dark =
        !faces_light(claim.tracer(), pixel.seen) || in_cone(claim, p) != Meeting::always;
    const bool may_be_lit =
        faces_light(claim.tracer(), pixel.seen) && in_cone(claim, p) != Meeting::never;
    if (may_be_dark && !pixel.shot && claimed == Visibility::shadowed) return {};
    if (!may_be_lit) return contradicted;
    if (!receives_shadows(claim.tracer(), pixel.seen))
        return claimed == Visibility::lit && !pixel.shot ? RayFault{} : contradicted;
    if (const RayFault fault = fault_of_shadow_ray(claim, p); !fault.empty()) return fault;
    const bool is_stopped = pixel.shot && pixel.occluder != no_triangle;
    return claimed == (is_stopped ? Visibility::shadowed : Visibility::lit) ? RayFault{}
                                                                            : contradicted;
}

/// What rays went through that they certainly meet. Eye rays look as far as to what they saw: by
/// 16 u nearer, as Embree compares rounded depths of different triangles.
void find_what_was_lost(const TracedClaim& claim, RayTile& tile, bool eye_rays) {
    AnyRays rays;
    CertainMeetings certain(claim, tile, eye_rays);
    for_lanes(tile.lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        const PixelPlace p = tile.places[l];
        const TracedPixel& pixel = claim.pixel(p);
        if (!tile.faults[l].empty()) return;
        if (eye_rays) {
            AnyRay ray = claim.eye_ray(p);
            if (pixel.seen != no_triangle) ray.far = pixel.depth * (1 - 16 * float_roundoff);
            certain.set(rays, lane, ray);
        } else if (pixel.shot && pixel.occluder == no_triangle) {
            certain.set(rays, lane, claim.shadow_ray(p));
        }
    });
    find_nearby(claim.tracer(), traversal_share, rays, certain);
    for_lanes(tile.lanes, [&](int lane) {
        if (certain.met(lane))
            tile.faults[static_cast<std::size_t>(lane)] =
                eye_rays ? "eye ray went through a triangle" : "shadow ray went through a triangle";
    });
}

} // namespace

void check_rays(const TracedClaim& claim, RayTile& tile) {
    for_lanes(tile.lanes, [&](int lane) {
        const auto l = static_cast<std::size_t>(lane);
        tile.faults[l] = fault_at(claim, tile.places[l]);
    });
    find_what_was_lost(claim, tile, true);
    find_what_was_lost(claim, tile, false);
}

} // namespace shadowproof
