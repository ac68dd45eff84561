// The picture divided into tiles of sixteen pixels, which are distributed over threads, each with
// its own Prober.
#pragma once

#include "reference/parallel.h"
#include "reference/trace/visibility.h"
#include "scenes/camera.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace shadowproof {

/// 4 x 4 pixels, or fewer at the right and lower borders.
struct Tile {
    Lanes<int> x{};
    Lanes<int> y{};
    Vectors directions;
    std::uint32_t lanes = 0; ///< one bit per pixel that lies within the picture
};

inline constexpr int tile_side = 4;

/// The rays of a picture's pixels, equal to ray_direction, from one vector per column and one per
/// row.
class PixelRays {
public:
    explicit PixelRays(const Camera& camera) {
        for (int x = 0; x < camera.width; ++x) columns_.push_back(ray_column(camera, x + 0.5));
        for (int y = 0; y < camera.height; ++y) rows_.push_back(ray_row(camera, y + 0.5));
    }

    glm::dvec3 at(int x, int y) const {
        return columns_[static_cast<std::size_t>(x)] + rows_[static_cast<std::size_t>(y)];
    }

    Tile tile(int left, int top) const {
        Tile tile;
        const int right = std::min(left + tile_side, static_cast<int>(columns_.size()));
        const int bottom = std::min(top + tile_side, static_cast<int>(rows_.size()));
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const auto lane = static_cast<std::size_t>((y - top) * tile_side + x - left);
                tile.x[lane] = x;
                tile.y[lane] = y;
                tile.directions.set(lane, at(x, y));
                tile.lanes |= 1U << lane;
            }
        return tile;
    }

private:
    std::vector<glm::dvec3> columns_;
    std::vector<glm::dvec3> rows_;
};

/// Calls work(prober, tile) for every tile of the picture. Returns the probers, one per thread that
/// worked, for their counts.
template <class Work>
std::vector<std::unique_ptr<Prober>> for_tiles(const Tracer::State& state, const Work& work,
                                               Filters filters = Filters::on) {
    const Camera& camera = state.scene->camera;
    const PixelRays rays(camera);
    std::vector<std::unique_ptr<Prober>> probers(static_cast<std::size_t>(state.threads));
    const int rows = (camera.height + tile_side - 1) / tile_side;
    parallel_for(rows, state.threads, [&](int row, int thread) {
        std::unique_ptr<Prober>& prober = probers[static_cast<std::size_t>(thread)];
        if (!prober) prober = std::make_unique<Prober>(state, filters);
        for (int left = 0; left < camera.width; left += tile_side)
            work(*prober, rays.tile(left, row * tile_side));
    });
    std::erase(probers, nullptr);
    return probers;
}

} // namespace shadowproof
