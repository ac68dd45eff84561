#include "reference/predict/ledger.h"

#include "reference/trace/tiles.h"

#include <cmath>

namespace shadowproof {

namespace {

/// Sets the counts of one picture at `point` of each pixel's ray.
template <class PointOf>
void count_tile(Prober& prober, const Tile& tile, Image<std::int32_t>& counts,
                const PointOf& point_of, Prober::Masks masks = Prober::Masks::ignored) {
    Lanes<Prober::Point> points{};
    std::uint32_t lanes = 0;
    for (std::size_t lane = 0; lane < packet_size; ++lane)
        if ((tile.lanes >> lane & 1U) != 0 && point_of(tile.x(lane), tile.y(lane), points[lane]))
            lanes |= 1U << lane;
    Lanes<std::int32_t> found{};
    prober.count(tile.lines, lanes, points, found, masks);
    for (std::size_t lane = 0; lane < packet_size; ++lane)
        if ((lanes >> lane & 1U) != 0) counts.at(tile.x(lane), tile.y(lane)) = found[lane];
}

template <class SurfaceOf>
ShadowDepths count_depths(const Tracer& tracer, double far, const SurfaceOf& surface_of) {
    const Tracer::State& state = tracer.state();
    const Camera& camera = state.scene->camera;
    ShadowDepths depths;
    depths.far = far;
    for (Image<std::int32_t>* image :
         {&depths.at_surface, &depths.at_near, &depths.at_far, &depths.at_infinity})
        *image = Image<std::int32_t>(camera.width, camera.height);

    const auto at_depth = [](double depth) {
        return [depth](int, int, Prober::Point& point) {
            point.depth = depth;
            return true;
        };
    };
    for_tiles(state, [&](Prober& prober, const Tile& tile) {
        count_tile(prober, tile, depths.at_surface, surface_of);
        count_tile(prober, tile, depths.at_near, at_depth(camera.near));
        count_tile(prober, tile, depths.at_far, at_depth(far));
        count_tile(prober, tile, depths.at_infinity, [](int, int, Prober::Point& point) {
            point.kind = RayPoint::Kind::infinity;
            return true;
        });
    });

    // The eye: depth 0 on a line of sight through it, or the end of all lines.
    Prober prober(state);
    Lanes<Prober::Point> points{};
    if (camera.is_orthographic()) points[0].kind = RayPoint::Kind::eye;
    Vectors lines;
    Lanes<std::int32_t> found{};
    lines.set(0, eye_line(camera));
    prober.count(lines, 1, points, found);
    depths.at_eye = found[0];
    return depths;
}

} // namespace

namespace {

/// The visible surface of each pixel.
auto surface_of(const GroundTruth& truth) {
    return [&truth](int x, int y, Prober::Point& point) {
        point.kind = RayPoint::Kind::surface;
        point.skip = truth.triangle.at(x, y);
        return point.skip != no_triangle;
    };
}

} // namespace

ShadowDepths count_shadow_depths(const Tracer& tracer, const GroundTruth& truth, double far) {
    return count_depths(tracer, far, surface_of(truth));
}

ShadowDepths count_shadow_depths_at(const Tracer& tracer, const Image<double>& surface,
                                    double far) {
    return count_depths(tracer, far, [&](int x, int y, Prober::Point& point) {
        point.depth = surface.at(x, y);
        return std::isfinite(point.depth);
    });
}

Image<std::int32_t> count_let_through(const Tracer& tracer, const GroundTruth& truth) {
    const Camera& camera = tracer.scene().camera;
    Image<std::int32_t> all(camera.width, camera.height);
    Image<std::int32_t> standing(camera.width, camera.height);
    for_tiles(tracer.state(), [&](Prober& prober, const Tile& tile) {
        count_tile(prober, tile, all, surface_of(truth));
        count_tile(prober, tile, standing, surface_of(truth), Prober::Masks::kept);
    });
    for (std::size_t i = 0; i < all.pixels.size(); ++i) all.pixels[i] -= standing.pixels[i];
    return all;
}

std::int32_t count_let_through(const Tracer& tracer, const glm::dvec3& line, std::uint32_t seen) {
    if (seen == no_triangle) return 0;
    Prober prober(tracer.state());
    Lanes<Prober::Point> points{};
    points[0] = {.kind = RayPoint::Kind::surface, .skip = seen};
    Vectors lines;
    lines.set(0, line);
    Lanes<std::int32_t> all{};
    Lanes<std::int32_t> standing{};
    prober.count(lines, 1, points, all);
    prober.count(lines, 1, points, standing, Prober::Masks::kept);
    return all[0] - standing[0];
}

} // namespace shadowproof
