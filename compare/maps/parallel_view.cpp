#include "compare/maps/parallel_view.h"

#include "compare/driver/mask_errors.h"
#include "compare/driver/setup_error.h"
#include "reference/parallel.h"
#include "reference/trace/faces.h"
#include "reference/trace/state.h"
#include "scenes/driver.h"
#include "scenes/surface/alpha_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether a caster shows the light a side that is drawn; an edge shows none.
bool is_drawn(const Scene& casters, std::uint32_t caster, MapCulling culling) {
    const double front = side(casters, caster, {-casters.camera.forward, 0.0});
    if (culling == MapCulling::front) return front < 0;
    return culling == MapCulling::back ? front > 0 : front != 0;
}

} // namespace

ParallelView::ParallelView(const Scene& scene, const MapEvidence& map, int subpixel_bits,
                           int threads)
    : LightView(scene, map), half_step_(half_snapping_step(subpixel_bits)) {
    casters_ = casters_alone(scene, true, of_scene_);
    casters_.camera = camera(0);
    reach_ = half_step_;
    std::vector<CasterBox> boxes;
    for (std::uint32_t caster = 0; caster < casters_.triangles.size(); ++caster) {
        drawn_.push_back(is_drawn(casters_, caster, map.model.culling) ? 1 : 0);
        CasterBox box{caster, glm::dvec2(infinity), glm::dvec2(-infinity)};
        for (const PicturePoint& point : pictured_in_parallel(casters_, camera(0), caster)) {
            box.low = glm::min(box.low, point.place - point.place_error);
            box.high = glm::max(box.high, point.place + point.place_error);
            reach_ = std::max(reach_, half_step_ + point.place_error);
        }
        if (box.low.x <= box.high.x) boxes.push_back(box);
    }
    grid_ = CasterGrid(std::move(boxes), map.model.size);
    caster_at_ = inverse_of(of_scene_, scene.triangles.size());
    if (!of_scene_.empty()) tracer_ = std::make_unique<Tracer>(casters_, threads);
}

std::uint32_t ParallelView::caster_of(std::uint32_t triangle) const {
    return caster_at_[triangle];
}

AnyRay ParallelView::ray_from(const glm::dvec3& origin, const LiftedLimits& lifted) const {
    const glm::dvec3& forward = camera(0).forward;
    if (lifted.range) return {origin, forward, -infinity, infinity};
    return {origin, forward, model().near, model().far};
}

AnyRay ParallelView::ray_at(double x, double y, const LiftedLimits& lifted) const {
    const Camera& from = camera(0);
    const double half = from.half_height;
    return ray_from(from.eye + half * (2 * x / from.width - 1) * from.right +
                        half * (1 - 2 * y / from.height) * from.up,
                    lifted);
}

AnyRay ParallelView::ray_through(const glm::dvec3& from_light, const LiftedLimits& lifted) const {
    const Camera& from = camera(0);
    const glm::dvec3 along = glm::dot(from_light, from.forward) * from.forward;
    return ray_from(from.eye + from_light - along, lifted);
}

std::vector<FromLight>
ParallelView::met(std::span<const AnyRay> rays, const LiftedLimits& lifted,
                  const std::function<bool(const AnyRay&, std::uint32_t)>& stands) const {
    std::vector<FromLight> found(rays.size(), {no_triangle, infinity});
    if (!tracer_) return found;
    const auto counts = [&](std::uint32_t caster) {
        return lifted.culling ? is_drawn(casters_, caster, MapCulling::none) : drawn_[caster] != 0;
    };
    const std::vector<MetTriangle> first = first_met(*tracer_, rays, counts, stands);
    for (std::size_t i = 0; i < first.size(); ++i)
        if (first[i].triangle != no_triangle) found[i] = {of_scene_[first[i].triangle], first[i].t};
    return found;
}

// As many at a time as first_met traces on the thread that asks.
void ParallelView::trace(std::span<const Texel> texels, const FoundTriangle& found) const {
    constexpr std::size_t together = 256;
    const auto pieces = static_cast<int>((texels.size() + together - 1) / together);
    parallel_for(pieces, tracer_ ? tracer_->threads() : 1, [&](int piece, int) {
        const std::size_t first = static_cast<std::size_t>(piece) * together;
        const std::span<const Texel> asked =
            texels.subspan(first, std::min(together, texels.size() - first));
        const std::vector<FromLight> met = trace_without({}, asked);
        for (std::size_t i = 0; i < met.size(); ++i) found(first + i, met[i].triangle);
    });
}

std::vector<FromLight> ParallelView::trace_without(const LiftedLimits& lifted,
                                                   std::span<const Texel> texels) const {
    std::vector<AnyRay> rays;
    rays.reserve(texels.size());
    for (const Texel& texel : texels) rays.push_back(ray_at(texel.x + 0.5, texel.y + 0.5, lifted));
    return met(rays, lifted);
}

std::vector<FromLight> ParallelView::trace_to(std::span<const PointOnFace> points,
                                              const LiftedLimits& lifted) const {
    std::vector<AnyRay> rays;
    rays.reserve(points.size());
    for (const PointOnFace& point : points) rays.push_back(ray_through(point.from_light, lifted));
    return met(rays, lifted);
}

ParallelView::Plane ParallelView::plane(const Texel& texel, std::uint32_t caster) const {
    const Camera& from = camera(0);
    const auto [a, b, c] = from_short_edge(corners(casters_, caster));
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double along = glm::dot(from.forward, normal);
    const double side_of_texel = 2 * from.half_height / from.width;
    return {glm::dot(a - ray_at(texel.x + 0.5, texel.y + 0.5).origin, normal) / along,
            side_of_texel *
                (std::abs(glm::dot(from.right, normal)) + std::abs(glm::dot(from.up, normal))) /
                std::abs(along)};
}

PolygonOffset ParallelView::offset(const Texel& texel, std::uint32_t caster) const {
    if (!model().has_offset()) return {};
    return polygon_offset(pictured_in_parallel(casters_, camera(0), caster),
                          {texel.x + 0.5, texel.y + 0.5}, model(), offset_unit(), {0, 1},
                          half_step_);
}

double ParallelView::moved_away(const Texel& texel, std::uint32_t triangle, double depth) const {
    return moved_by(depth, offset(texel, caster_of(triangle)).own);
}

// A corner snapped aside moves the plane by its slope; set-up comes with the corners' own errors;
// the window's roundings are those of a depth, and of its sum with a polygon offset; and the format
// rounds.
double ParallelView::error(const Texel& texel, std::uint32_t caster, const Plane& plane) const {
    const glm::dvec2 place(texel.x + 0.5, texel.y + 0.5);
    return least_error(plane) +
           window_depth_error(pictured_in_parallel(casters_, camera(0), caster), place, half_step_);
}

double ParallelView::least_error(const Plane& plane) const {
    return half_step_ * plane.slope / (model().far - model().near) +
           (window_depth_roundings + 1) * float_roundoff + half_step();
}

bool ParallelView::may_store(const Texel& texel, std::uint32_t caster) const {
    const Plane at = plane(texel, caster);
    if (!at.has_depth()) return true; // seen edge-on: any depth may come out
    const PolygonOffset moved = offset(texel, caster);
    const double depth = window(at.depth);
    // A part of the error that is nearly always enough, without what set-up adds.
    if (moved.most == 0 && std::abs(stored(texel) - depth) <= least_error(at)) return true;
    const double off = error(texel, caster, at);
    return stored(texel) >= std::min(depth + moved.least, 1.0) - off &&
           stored(texel) <= depth + moved.most + off;
}

bool ParallelView::may_draw(const Texel& texel, std::uint32_t caster) const {
    const glm::dvec2 place(texel.x + 0.5, texel.y + 0.5);
    const std::vector<PicturePoint> polygon = pictured_in_parallel(casters_, camera(0), caster);
    return may_hold(polygon, place, std::numbers::sqrt2 * half_step_) &&
           (drawn_[caster] != 0 || may_be_flipped(polygon, half_step_));
}

// Coordinates are interpolated by a plane over the picture, as window depths are, and divided by w,
// which is 1. Of a caster that the near or far plane cuts nothing is known.
MaskError ParallelView::mask_error(const Texel& texel, std::uint32_t caster) const {
    const std::vector<PicturePoint> polygon = pictured_in_parallel(casters_, camera(0), caster);
    if (polygon.size() != 3 || std::ranges::any_of(polygon, &PicturePoint::made_by_clipping))
        return {.at = glm::dvec2(infinity)};
    const std::array<glm::dvec2, 3> at = mask_coordinates(casters_, caster);
    MaskError error{.alpha = alpha_roundings};
    for (int axis = 0; axis < 2; ++axis) {
        std::array<PicturePoint, 3> corners{polygon[0], polygon[1], polygon[2]};
        double largest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k].key = at[k][axis];
            corners[k].depth_error = 0;
            largest = std::max(largest, std::abs(at[k][axis]));
        }
        error.at[axis] = setup_error(corners, {texel.x + 0.5, texel.y + 0.5}, half_step_) +
                         8 * float_roundoff * largest + mask_place_roundings;
    }
    return error;
}

/// Of a caster that has a mask.
bool ParallelView::stands(const Texel& texel, const AnyRay& ray, std::uint32_t caster,
                          MaskReading reading) const {
    return may_stand_on_ray({ray.origin, ray.direction, {}}, tracer_->state().masked(caster),
                            mask_error(texel, caster), reading);
}

bool ParallelView::may_stand(const Texel& texel, std::span<const AnyRay> rays,
                             std::uint32_t caster) const {
    return !has_mask(casters_, caster) || std::ranges::any_of(rays, [&](const AnyRay& ray) {
        return stands(texel, ray, caster, MaskReading::most);
    });
}

/// What rays meet that pass a texel, as its masks may be read.
std::vector<FromLight> ParallelView::met_in_all_ways(const Texel& texel,
                                                     std::span<const AnyRay> rays) const {
    std::vector<FromLight> all = met(rays);
    if (!has_masks(casters_)) return all;
    for (const MaskReading reading : {MaskReading::most, MaskReading::least}) {
        const std::vector<FromLight> more =
            met(rays, {}, [&](const AnyRay& ray, std::uint32_t caster) {
                return stands(texel, ray, caster, reading);
            });
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

LightView::Shown ParallelView::showing(const Texel& texel, std::uint32_t triangle) const {
    if (triangle == no_triangle) return {};
    const double depth = plane(texel, caster_of(triangle)).depth;
    return {triangle, depth, moved_away(texel, triangle, depth)};
}

bool ParallelView::may_show(const Texel& texel, std::uint32_t triangle) const {
    return may_store(texel, caster_of(triangle));
}

// Next to an outline any triangle that may cover the centre may be stored, none farther than what
// is seen all around. What lies as near to the near or far plane as its depth is off may be
// clipped, and what may be flipped, culled: neither hides anything.
std::optional<std::uint32_t> ParallelView::shown_around(const Texel& texel) const {
    constexpr std::array steps{0.0, -1.0, 1.0, -0.5, 0.5};
    std::vector<AnyRay> rays;
    for (const double right : steps)
        for (const double down : steps)
            rays.push_back(ray_at(texel.x + 0.5 + reach_ * right, texel.y + 0.5 + reach_ * down));
    double farthest = 0;
    for (const FromLight& seen : met_in_all_ways(texel, rays)) {
        double hidden_behind = infinity;
        if (seen.triangle != no_triangle) {
            const std::uint32_t caster = caster_of(seen.triangle);
            const Plane at = plane(texel, caster);
            const double off = at.has_depth() ? error(texel, caster, at) : infinity;
            const double depth = window(at.depth);
            const bool hides =
                depth - off > 0 && depth + off < 1 &&
                !may_be_flipped(pictured_in_parallel(casters_, camera(0), caster), half_step_);
            if (hides) hidden_behind = depth + off + offset(texel, caster).most;
        }
        if (hidden_behind == infinity && stored(texel) == 1) return no_triangle;
        farthest = std::max(farthest, hidden_behind);
    }
    if (stored(texel) > farthest) return std::nullopt;
    const glm::dvec2 place(texel.x + 0.5, texel.y + 0.5);
    for (const std::uint32_t caster : grid_.around(place, std::numbers::sqrt2 * half_step_))
        if (may_draw(texel, caster) && may_store(texel, caster) && may_stand(texel, rays, caster))
            return of_scene_[caster];
    return std::nullopt;
}

} // namespace shadowproof
