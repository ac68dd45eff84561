#include "reference/trace/first_met.h"

#include "reference/parallel.h"
#include "reference/trace/faces.h"
#include "reference/trace/lanes.h"
#include "reference/trace/state.h"
#include "scenes/roundoff.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

/// Boxes are compared in double: three roundings of at most the largest coordinate each.
constexpr double double_share = 0x1p-48;

/// Between which places along the ray the triangle lies, rounded outwards: a place is the quotient
/// of two sums of three products, of which the longer's terms are differences.
std::pair<double, double> reach_along(const AnyRay& ray, const Corners& t) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    const double square = glm::dot(ray.direction, ray.direction);
    for (const glm::dvec3& corner : {t.a, t.b, t.c}) {
        const glm::dvec3 way = corner - ray.origin;
        const double place = glm::dot(way, ray.direction) / square;
        const double error =
            16 * double_roundoff * glm::dot(glm::abs(way), glm::abs(ray.direction)) / square;
        least = std::min(least, place - error);
        most = std::max(most, place + error);
    }
    return {least, most};
}

/// Keeps the nearest triangle of each ray.
class Nearest final : public NearbyTriangles {
public:
    Nearest(const Tracer& tracer, const std::function<bool(std::uint32_t)>& counts,
            const std::function<bool(const AnyRay&, std::uint32_t)>& stands)
        : tracer_(tracer), counts_(counts), stands_(stands) {}

    void visit(AnyRays& rays, std::uint32_t triangle, std::uint32_t lanes) override {
        if (!counts_(triangle)) return;
        const Corners t = corners(tracer_.scene(), triangle);
        const LanesBeside sides = lanes_beside(rays, t);
        lanes &= ~sides.beside;
        for (; lanes != 0; lanes &= lanes - 1) {
            const int lane = __builtin_ctz(lanes);
            AnyRay ray = rays.ray(lane);
            ray.far = far[static_cast<std::size_t>(lane)];
            const auto [least, most] = reach_along(ray, t);
            if (most <= ray.near || least > rays.far[static_cast<std::size_t>(lane)]) continue;
            const bool is_within = least > ray.near && most <= ray.far;
            const bool is_through = (sides.through >> lane & 1U) != 0;
            if (is_through ? !is_within && !meets_plane(ray, t) : !meets(ray, t)) continue;
            if (!stands(ray, triangle)) continue;
            MetTriangle& nearest = found[static_cast<std::size_t>(lane)];
            double& least_found = least_of_found_[static_cast<std::size_t>(lane)];
            const bool is_first = nearest.triangle == no_triangle || most < least_found;
            const int order =
                is_first ? -1 : order_along(ray, t, corners(tracer_.scene(), nearest.triangle));
            if (order > 0 || (order == 0 && triangle > nearest.triangle)) continue;
            nearest = {triangle, std::clamp(place_on_plane(ray, t), least, most)};
            least_found = least;
            rays.far[static_cast<std::size_t>(lane)] = std::min(ray.far, most);
        }
    }

    Lanes<double> far{}; ///< the rays' own
    Lanes<MetTriangle> found{};

private:
    const Tracer& tracer_;
    const std::function<bool(std::uint32_t)>& counts_;
    const std::function<bool(const AnyRay&, std::uint32_t)>& stands_;
    Lanes<double> least_of_found_{}; ///< reach_along of the nearest so far

    bool stands(const AnyRay& ray, std::uint32_t triangle) const {
        if (!tracer_.state().has_mask(triangle)) return true;
        return stands_ ? stands_(ray, triangle) : stands_on_ray(tracer_, ray, triangle);
    }
};

} // namespace

double place_on_plane(const AnyRay& ray, const Corners& t) {
    const auto [a, b, c] = from_short_edge({t.a, t.b, t.c});
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    return glm::dot(a - ray.origin, normal) / glm::dot(ray.direction, normal);
}

std::vector<MetTriangle>
first_met(const Tracer& tracer, std::span<const AnyRay> rays,
          const std::function<bool(std::uint32_t)>& counts,
          const std::function<bool(const AnyRay&, std::uint32_t)>& stands) {
    std::vector<MetTriangle> found(rays.size());
    const auto trace = [&](int packet, int) {
        const std::size_t first = static_cast<std::size_t>(packet) * packet_size;
        const std::size_t count = std::min<std::size_t>(packet_size, rays.size() - first);
        Nearest nearest(tracer, counts, stands);
        AnyRays together;
        for (std::size_t i = 0; i < count; ++i) {
            together.set(static_cast<int>(i), rays[first + i]);
            nearest.far[i] = rays[first + i].far;
        }
        find_nearby(tracer, double_share, together, nearest);
        std::copy_n(nearest.found.begin(), count,
                    found.begin() + static_cast<std::ptrdiff_t>(first));
    };
    const auto packets = static_cast<int>((rays.size() + packet_size - 1) / packet_size);
    constexpr int few = 16;
    if (packets <= few) {
        for (int packet = 0; packet < packets; ++packet) trace(packet, 0);
    } else {
        parallel_for(packets, tracer.threads(), trace);
    }
    return found;
}

} // namespace shadowproof
