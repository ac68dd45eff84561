#include "reference/ledger.h"

#include "reference/tiles.h"

#include <cmath>

namespace shadowproof {

namespace {

/// Sets the counts of one picture at `point` of each pixel's ray.
template <class PointOf>
void count_tile(Prober& prober, const Tile& tile, Image<std::int32_t>& counts,
                const PointOf& point_of) {
    Lanes<Prober::Point> points{};
    std::uint32_t lanes = 0;
    for (std::size_t lane = 0; lane < packet_size; ++lane)
        if ((tile.lanes >> lane & 1U) != 0 && point_of(tile.x[lane], tile.y[lane], points[lane]))
            lanes |= 1U << lane;
    Lanes<std::int32_t> found{};
    prober.count(tile.directions, lanes, points, found);
    for (std::size_t lane = 0; lane < packet_size; ++lane)
        if ((lanes >> lane & 1U) != 0) counts.at(tile.x[lane], tile.y[lane]) = found[lane];
}

} // namespace

ShadowDepths count_shadow_depths(const Tracer& tracer, const GroundTruth& truth, double far) {
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
    const auto at_surface = [&](int x, int y, Prober::Point& point) {
        point.kind = RayPoint::Kind::surface;
        point.skip = truth.triangle.at(x, y);
        return point.skip != no_triangle;
    };
    for_tiles(state, [&](Prober& prober, const Tile& tile) {
        count_tile(prober, tile, depths.at_surface, at_surface);
        count_tile(prober, tile, depths.at_near, at_depth(camera.near));
        count_tile(prober, tile, depths.at_far, at_depth(far));
        count_tile(prober, tile, depths.at_infinity, [](int, int, Prober::Point& point) {
            point.kind = RayPoint::Kind::infinity;
            return true;
        });
    });

    // The eye: depth 0 on any ray.
    Prober prober(state);
    Lanes<Prober::Point> points{};
    Lanes<glm::dvec3> directions{};
    Lanes<std::int32_t> found{};
    directions[0] = camera.forward;
    prober.count(directions, 1, points, found);
    depths.at_eye = found[0];
    return depths;
}

std::int64_t predicted_count(const ShadowDepths& depths, const GroundTruth& truth, int x, int y,
                             const Counting& counting, const DepthModel& depth_model) {
    const bool infinite = depth_model.projection != DepthModel::Projection::finite;
    const bool background = truth.triangle.at(x, y) == no_triangle;
    // A clamped or finite picture's background is at its far plane, an infinite one's at infinity.
    std::int64_t at_surface = depths.at_surface.at(x, y);
    if (background) at_surface = infinite ? depths.at_infinity.at(x, y) : depths.at_far.at(x, y);
    if (counting.test == Counting::Test::depth_pass)
        return at_surface - (counting.depth_clamp ? depths.at_eye : depths.at_near.at(x, y));
    // Faces past a far plane that clips are lost, and with them what contains that plane.
    if (!infinite && !counting.depth_clamp) return at_surface - depths.at_far.at(x, y);
    if (!counting.dark_cap) return at_surface - depths.at_infinity.at(x, y);
    return at_surface;
}

} // namespace shadowproof
