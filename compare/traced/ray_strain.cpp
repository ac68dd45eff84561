#include "compare/traced/ray_strain.h"

#include "compare/judge/depends_on_shadow.h"
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
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Standard deviation of one rounding, of a number of size 1.
const double of_rounding = deviation_of_rounding * float_roundoff;

/// A lit or shadowed point whose answer depends on a shadow ray.
struct StartingPoint {
    PixelPlace place{};
    std::uint32_t seen = no_triangle;
    bool lit = false;
    glm::dvec3 eye{0, 0, 0}; ///< where the eye ray starts
    glm::dvec3 at{0, 0, 0};
    glm::dvec3 normal{0, 0, 0}; ///< unit, on the light's side
    glm::dvec3 to_light{0, 0, 0};
};

/// None where the claim depends on no ray, or the truth is a tie, which any error may break.
std::optional<StartingPoint> starting_point(const TracedClaim& claim, PixelPlace p) {
    const Scene& scene = claim.scene();
    const GroundTruth& truth = claim.traced.truth();
    if (!depends_on_shadow(claim.traced, p)) return std::nullopt;
    if (truth.exactness.at(p.x, p.y) == Exactness::degenerate) return std::nullopt;
    StartingPoint start{.place = p, .seen = truth.triangle.at(p.x, p.y)};
    start.lit = truth.visibility.at(p.x, p.y) == Visibility::lit;
    const glm::dvec3 line = line_of_sight(scene.camera, p.x + 0.5, p.y + 0.5);
    start.eye = start_of(scene.camera, line);
    start.at = point_on(scene.camera, line, truth.depth.at(p.x, p.y));
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    start.to_light = glm::dvec3(light) - light.w * start.at;
    const Corners t = corners(scene, start.seen);
    start.normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
    if (!std::isfinite(glm::dot(start.normal, start.to_light))) return std::nullopt; // no area
    if (glm::dot(start.normal, start.to_light) < 0) start.normal = -start.normal;
    return start;
}

/// The shadow ray as the model starts it, but for rounding to double.
AnyRay exact_ray(const TracedClaim& claim, const StartingPoint& start, const RayModel& model) {
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

/// Which of up to sixteen rays give another answer than the truth: one bit for each.
std::uint32_t wrong_with(const TracedClaim& claim, std::span<const StartingPoint> starts,
                         const RayModel& model) {
    AnyRays rays;
    std::uint32_t lit = 0;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        rays.set(static_cast<int>(i), exact_ray(claim, starts[i], model));
        if (starts[i].lit) lit |= 1U << i;
    }
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << starts.size()) - 1);
    Stopped stopped(claim, starts);
    find_nearby(claim.tracer(), traversal_share, rays, stopped);
    return ~(stopped.stopped() ^ lit) & all;
}

/// Whether the distance that the model keeps is what makes any of them wrong. Without one, what
/// stands between the point and the light is not the point's own triangle, and exact rays are
/// right; where doubles are not, they tell nothing of the distance.
bool fails_by_model(const TracedClaim& claim, std::span<const StartingPoint> starts) {
    RayModel model = claim.rays().model;
    if (model.start == RayModel::Start::skip || !(model.distance > 0)) return false;
    const std::uint32_t wrong = wrong_with(claim, starts, model);
    if (wrong == 0) return false;
    model.distance = 0;
    return (wrong & ~wrong_with(claim, starts, model)) != 0;
}

double squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

// Embree's distance is t = T / den = N . C / N . D, with N = e2 x e1 and C = a - o
// (float_bounds.h). What N is off by moves T and den together: t by that times a - P over den, so
// that it counts for little in small triangles. Of N's components each product is rounded four
// times: both edges, the product and the difference; of T's products C, the product and two sums;
// of den's all but C; and the quotient. Along the normal that is D . N over |N| as much. The
// point's coordinates are a product and a sum, once more each with an offset. And the ray that
// starts there meets its triangle at another distance of that kind, whose C is a - P.
double deviation_along_normal(const TracedClaim& claim, const StartingPoint& start) {
    const Corners t = corners(claim.scene(), start.seen);
    const glm::dvec3 e1 = t.a - t.b;
    const glm::dvec3 e2 = t.c - t.a;
    const glm::dvec3 normal = glm::cross(e2, e1);
    const glm::dvec3 way = start.at - start.eye;
    const glm::dvec3 to_a = t.a - start.at;
    double lever = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const double products = std::hypot(e2[j] * e1[k], e2[k] * e1[j]) * to_a[i];
        lever += 4 * products * products;
    }
    const double of_eye_ray = 4 * squared(normal * (t.a - start.eye)) + 3 * squared(normal * way);
    const double of_shadow_ray = 4 * squared(normal * to_a);
    const double distances =
        std::sqrt(2 * lever + of_eye_ray + of_shadow_ray) / glm::length(normal);
    const double quotient = glm::dot(way, start.normal);
    const bool moved = claim.rays().model.start == RayModel::Start::offset;
    const double coordinates =
        std::sqrt(squared(start.normal * way) + (moved ? 3 : 1) * squared(start.normal * start.at));
    return of_rounding * std::hypot(distances, quotient, coordinates);
}

// Along each axis: eye and D are floats, and so are the product and the sum of the two.
double deviation_aside(const StartingPoint& start) {
    const double sizes = squared(start.eye) + 2 * squared(start.at - start.eye) + squared(start.at);
    return of_rounding * std::sqrt(sizes / 3);
}

/// How far a ray from a point to the light comes along its triangle's normal before it has left the
/// triangle; infinite where the light is straight above.
double height_at_edge(const Corners& t, const StartingPoint& start) {
    const double up = glm::dot(start.to_light, start.normal);
    const glm::dvec3 over = start.to_light - up * start.normal;
    const std::array<glm::dvec3, 3> at{t.a, t.b, t.c};
    double least = infinity; // of the ray's parameter
    for (std::size_t k = 0; k < at.size(); ++k) {
        const glm::dvec3 edge = at[(k + 1) % 3] - at[k];
        glm::dvec3 inwards = glm::cross(start.normal, edge);
        if (glm::dot(inwards, at[(k + 2) % 3] - at[k]) < 0) inwards = -inwards;
        const double closer = -glm::dot(over, inwards);
        if (closer > 0)
            least = std::min(least, std::max(glm::dot(start.at - at[k], inwards), 0.0) / closer);
    }
    return least * up;
}

/// The chance that a lit point's ray meets the surface that it starts below: its own triangle, at
/// the depth below over the cosine with the light, or, where that is skipped, the next one, if it
/// is below still when it leaves the first.
double chance_of_acne(const TracedClaim& claim, const StartingPoint& start) {
    if (!start.lit) return 0;
    const RayModel& model = claim.rays().model;
    double kept = model.distance;
    if (model.start == RayModel::Start::epsilon)
        kept *= glm::dot(start.normal, glm::normalize(start.to_light));
    if (model.start == RayModel::Start::skip)
        kept = height_at_edge(corners(claim.scene(), start.seen), start);
    return share_beyond(kept, deviation_along_normal(claim, start));
}

/// Of a point less than a standard deviation s from a border, on average: the share beyond a border
/// at the distance x, over all x, adds up to 0.4 s.
constexpr double chance_beside_border = 0.4;

/// Rays a standard deviation to each side of a pixel's centre.
std::array<glm::dvec3, 4> rays_aside(const TracedClaim& claim, const StartingPoint& start) {
    const Camera& camera = claim.scene().camera;
    const double pixels =
        deviation_aside(start) * pixels_of_length(camera, view_depth(camera, start.at));
    const double x = start.place.x + 0.5;
    const double y = start.place.y + 0.5;
    return {line_of_sight(camera, x - pixels, y), line_of_sight(camera, x + pixels, y),
            line_of_sight(camera, x, y - pixels), line_of_sight(camera, x, y + pixels)};
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
        double& sum = expected[static_cast<std::size_t>(group)];
        if (fails_by_model(claim, some)) sum = infinity;
        for (std::size_t i = 0; i < some.size(); ++i) {
            sum += chance_of_acne(claim, some[i]);
            std::ranges::copy(rays_aside(claim, some[i]),
                              aside.begin() + static_cast<std::ptrdiff_t>(4 * (first + i)));
        }
    });
    double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
    if (std::isinf(sum)) return sum;
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
    for (int top = 0; top < height && std::isfinite(sum); top += rows_at_once)
        sum += expected_wrong(claim, top, std::min(top + rows_at_once, height));
    return sum / std::numbers::ln2;
}

} // namespace shadowproof
