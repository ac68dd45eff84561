#include "compare/traced/ray_strain.h"

#include "compare/judge/normal_distribution.h"
#include "reference/parallel.h"
#include "scenes/camera.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Standard deviation of one rounding, of a number of size 1.
const double of_rounding = 0.5 * float_roundoff / std::sqrt(3.0);

/// A lit or shadowed point whose answer depends on a shadow ray.
struct StartingPoint {
    PixelPlace place{};
    std::uint32_t seen = no_triangle;
    bool lit = false;
    glm::dvec3 direction{0, 0, 0}; ///< of the eye ray
    glm::dvec3 at{0, 0, 0};
    glm::dvec3 normal{0, 0, 0}; ///< unit, on the light's side
    glm::dvec3 to_light{0, 0, 0};
};

/// None where the claim depends on no ray.
std::optional<StartingPoint> starting_point(const TracedClaim& claim, PixelPlace p) {
    const Scene& scene = claim.scene();
    const GroundTruth& truth = claim.traced.truth();
    StartingPoint start{.place = p, .seen = truth.triangle.at(p.x, p.y)};
    if (start.seen == no_triangle || !receives_shadows(claim.tracer(), start.seen) ||
        !faces_light(claim.tracer(), start.seen))
        return std::nullopt;
    if (!truth.in_cone.pixels.empty() && truth.in_cone.at(p.x, p.y) == 0) return std::nullopt;
    start.lit = truth.visibility.at(p.x, p.y) == Visibility::lit;
    start.direction = ray_direction(scene.camera, p.x + 0.5, p.y + 0.5);
    start.at = scene.camera.eye + truth.depth.at(p.x, p.y) * start.direction;
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    start.to_light = glm::dvec3(light) - light.w * start.at;
    const Corners t = corners(scene, start.seen);
    start.normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
    if (!std::isfinite(glm::dot(start.normal, start.to_light))) return std::nullopt; // no area
    if (glm::dot(start.normal, start.to_light) < 0) start.normal = -start.normal;
    return start;
}

/// The shadow ray as the model starts it, with exact numbers.
AnyRay exact_ray(const TracedClaim& claim, const StartingPoint& start) {
    const RayModel& model = claim.rays().model;
    const glm::dvec4 light = homogeneous(chosen_light(claim.scene()));
    AnyRay ray;
    ray.origin = start.at;
    if (model.start == RayModel::Start::offset) ray.origin += double{model.distance} * start.normal;
    const glm::dvec3 way = glm::dvec3(light) - light.w * ray.origin;
    ray.direction = glm::normalize(way);
    if (model.start == RayModel::Start::epsilon) ray.near = model.distance;
    if (light.w != 0) ray.far = glm::length(way);
    return ray;
}

/// Which of up to sixteen rays something stands in the way of, besides their own triangles: one bit
/// for each.
class Stopped final : public NearbyTriangles {
public:
    Stopped(const TracedClaim& claim, std::span<const StartingPoint> starts)
        : claim_(claim), starts_(starts) {}

    void visit(AnyRays& rays, std::uint32_t triangle, std::uint32_t lanes) override {
        if (claim_.tables.casts[triangle] == 0) return;
        const Corners t = corners(claim_.scene(), triangle);
        for (std::size_t lane = 0; lane < starts_.size(); ++lane) {
            if ((lanes & rays.lanes & 1U << lane) == 0 || starts_[lane].seen == triangle) continue;
            const AnyRay ray = rays.ray(static_cast<int>(lane));
            if (!meets(ray, t) || !stands_on_ray(claim_.tracer(), ray, triangle)) continue;
            stopped_ |= 1U << lane;
            rays.lanes &= ~(1U << lane);
        }
    }
    std::uint32_t stopped() const { return stopped_; }

private:
    const TracedClaim& claim_;
    std::span<const StartingPoint> starts_;
    std::uint32_t stopped_ = 0;
};

/// Whether exact numbers give the truth, for each of up to sixteen. Where no distance is kept they
/// do: what stands between the point and the light is not the point's own triangle.
std::uint32_t right_by_model(const TracedClaim& claim, std::span<const StartingPoint> starts) {
    std::uint32_t lit = 0;
    for (std::size_t i = 0; i < starts.size(); ++i)
        if (starts[i].lit) lit |= 1U << i;
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << starts.size()) - 1);
    if (claim.rays().model.start == RayModel::Start::skip || !(claim.rays().model.distance > 0))
        return all;
    AnyRays rays;
    for (std::size_t i = 0; i < starts.size(); ++i)
        rays.set(static_cast<int>(i), exact_ray(claim, starts[i]));
    Stopped stopped(claim, starts);
    find_nearby(claim.tracer(), traversal_share, rays, stopped);
    return (stopped.stopped() ^ lit) & all;
}

/// The standard deviations of the point that is met, in world units.
struct Deviation {
    double along_normal = 0;
    double aside = 0; ///< of the eye ray
};

// Embree's distance is t = T / den = N . C / N . D, with N = e2 x e1 and C = a - o
// (float_bounds.h). What N is off by moves T and den together: t by that times a - P over den, so
// that it counts for little in small triangles. Of N's components each product is rounded four
// times: both edges, the product and the difference; of T's products C, the product and two sums;
// of den's all but C; and the quotient.
double deviation_of_distance(const Corners& t, const glm::dvec3& eye, const StartingPoint& start) {
    const glm::dvec3 e1 = t.a - t.b;
    const glm::dvec3 e2 = t.c - t.a;
    const glm::dvec3 normal = glm::cross(e2, e1);
    const glm::dvec3 to_a = t.a - eye;
    const glm::dvec3 way = start.at - eye;
    const auto squared = [](const glm::dvec3& v) { return glm::dot(v, v); };
    double sum = 4 * squared(normal * to_a) + 3 * squared(normal * way);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const double products = std::hypot(e2[j] * e1[k], e2[k] * e1[j]);
        const double lever = products * (t.a - start.at)[i];
        sum += 4 * lever * lever;
    }
    const double den = glm::dot(normal, start.direction);
    const double distance = glm::length(way) / glm::length(start.direction);
    return of_rounding * std::hypot(std::sqrt(sum) / den, distance);
}

// A point is eye + t D, where eye and D are floats: rounding those moves it sideways, and along its
// surface. The product and the sum are rounded, too.
Deviation deviation_at(const TracedClaim& claim, const StartingPoint& start) {
    const glm::dvec3 eye = claim.scene().camera.eye;
    const glm::dvec3 way = start.at - eye;
    const double along = deviation_of_distance(corners(claim.scene(), start.seen), eye, start) *
                         glm::dot(start.direction, start.normal);
    const glm::dvec3 coordinates(std::hypot(way.x, start.at.x), std::hypot(way.y, start.at.y),
                                 std::hypot(way.z, start.at.z));
    const double rounded = of_rounding * glm::length(start.normal * coordinates);
    const double of_ray =
        of_rounding * std::hypot(glm::length(eye), glm::length(way), glm::length(start.at));
    return {std::hypot(along, rounded), of_ray};
}

/// How far a point may be moved over its triangle, towards the light, before it leaves that.
double way_to_edge(const Corners& t, const StartingPoint& start) {
    const glm::dvec3 over = start.to_light - glm::dot(start.to_light, start.normal) * start.normal;
    const glm::dvec3 towards = glm::normalize(over); // no number where the light is straight above
    const std::array<glm::dvec3, 3> at{t.a, t.b, t.c};
    double least = infinity;
    for (std::size_t k = 0; k < at.size(); ++k) {
        const glm::dvec3 edge = at[(k + 1) % 3] - at[k];
        glm::dvec3 inwards = glm::cross(start.normal, edge);
        if (glm::dot(inwards, at[(k + 2) % 3] - at[k]) < 0) inwards = -inwards;
        const double closer = -glm::dot(towards, inwards);
        if (closer > 0)
            least = std::min(least, std::max(glm::dot(start.at - at[k], inwards), 0.0) / closer);
    }
    return least;
}

/// The chance that a lit point's ray meets the surface that it starts below: its own triangle, at
/// the depth below over the cosine with the light, or, where that is skipped, the next one, if it
/// is below still when it leaves the first.
double chance_of_acne(const TracedClaim& claim, const StartingPoint& start, double deviation) {
    if (!start.lit) return 0;
    const RayModel& model = claim.rays().model;
    const double cosine = glm::dot(start.normal, glm::normalize(start.to_light));
    double kept = model.distance;
    if (model.start == RayModel::Start::epsilon) kept *= cosine;
    if (model.start == RayModel::Start::skip)
        kept = way_to_edge(corners(claim.scene(), start.seen), start) * cosine /
               std::sqrt(std::max(1 - cosine * cosine, 0.0));
    return share_beyond(kept, deviation);
}

/// Rays a standard deviation aside of a pixel's centre. A normal error takes a point over a border
/// at a distance x as often as beyond x: over all x, 0.4 deviations to either side, where the
/// border is less than one away.
constexpr double chance_beside_border = 0.4;
std::array<glm::dvec3, 4> rays_aside(const TracedClaim& claim, const StartingPoint& start,
                                     double aside) {
    const Camera& camera = claim.scene().camera;
    const double depth = view_depth(camera, start.at);
    const double pixels = aside * 0.5 * camera.height / (camera.tan_half_height * depth);
    const double x = start.place.x + 0.5;
    const double y = start.place.y + 0.5;
    return corner_rays(camera, x - pixels, y - pixels, x + pixels, y + pixels);
}

/// Rows that are looked at together, so that few points are kept at once.
constexpr int rows_at_once = 64;

std::vector<StartingPoint> starting_points(const TracedClaim& claim, int top, int bottom) {
    std::vector<StartingPoint> starts;
    for (int y = top; y < bottom; ++y)
        for (int x = 0; x < claim.scene().camera.width; ++x)
            if (const auto start = starting_point(claim, {x, y})) starts.push_back(*start);
    return starts;
}

/// Pixels that are expected to be wrong between two rows.
double expected_wrong(const TracedClaim& claim, int top, int bottom) {
    const std::vector<StartingPoint> starts = starting_points(claim, top, bottom);
    const auto groups = static_cast<int>((starts.size() + packet_size - 1) / packet_size);
    std::vector<double> expected(static_cast<std::size_t>(groups));
    std::vector<glm::dvec3> aside(4 * starts.size());
    parallel_for(groups, claim.tracer().threads(), [&](int group, int) {
        const std::size_t first = static_cast<std::size_t>(group) * packet_size;
        const auto some = std::span(starts).subspan(
            first, std::min<std::size_t>(packet_size, starts.size() - first));
        const std::uint32_t right = right_by_model(claim, some);
        double& sum = expected[static_cast<std::size_t>(group)];
        for (std::size_t i = 0; i < some.size(); ++i) {
            if ((right >> i & 1U) == 0) sum = infinity;
            const Deviation deviation = deviation_at(claim, some[i]);
            sum += chance_of_acne(claim, some[i], deviation.along_normal);
            std::ranges::copy(rays_aside(claim, some[i], deviation.aside),
                              aside.begin() + static_cast<std::ptrdiff_t>(4 * (first + i)));
        }
    });
    double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
    const std::vector<RayTruth> truths = trace_rays(claim.tracer(), aside);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const Visibility own = starts[i].lit ? Visibility::lit : Visibility::shadowed;
        if (std::ranges::any_of(std::span(truths).subspan(4 * i, 4),
                                [&](const RayTruth& t) { return t.visibility != own; }))
            sum += chance_beside_border;
    }
    return sum;
}

} // namespace

double strain(const TracedClaim& claim) {
    double sum = 0;
    const int height = claim.scene().camera.height;
    for (int top = 0; top < height; top += rows_at_once)
        sum += expected_wrong(claim, top, std::min(top + rows_at_once, height));
    return sum / std::numbers::ln2;
}

} // namespace shadowproof
