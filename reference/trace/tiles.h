// The picture divided into tiles of sixteen pixels, which are distributed over threads, each with
// its own Prober.
#pragma once

#include "reference/parallel.h"
#include "reference/trace/visibility.h"
#include "scenes/camera.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace shadowproof {

inline constexpr int tile_side = 4;

/// 4 x 4 pixels, row by row, or fewer at the right and lower borders.
struct Tile {
    int left = 0;
    int top = 0;
    std::uint32_t lanes = 0; ///< one bit per pixel that lies within the picture
    Vectors directions;

    int x(std::size_t lane) const { return left + static_cast<int>(lane) % tile_side; }
    int y(std::size_t lane) const { return top + static_cast<int>(lane) / tile_side; }
};

/// The rays of a picture's pixels, equal to ray_direction, from one vector per column and one per
/// row. Beyond the picture they are those of its last column and row.
class PixelRays {
public:
    explicit PixelRays(const Camera& camera) : width_(camera.width), height_(camera.height) {
        const auto fill = [](std::array<std::vector<double>, 3>& axes, int count, const auto& of) {
            for (int i = 0; i < padded(count); ++i) {
                const glm::dvec3 v = of(std::min(i, count - 1) + 0.5);
                for (std::size_t k = 0; k < 3; ++k) axes[k].push_back(v[static_cast<int>(k)]);
            }
        };
        fill(columns_, width_, [&](double x) { return ray_column(camera, x); });
        fill(rows_, height_, [&](double y) { return ray_row(camera, y); });
    }

    void set(Tile& tile, int left, int top) const {
        tile.left = left;
        tile.top = top;
        const int right = std::min(tile_side, width_ - left);
        const int bottom = std::min(tile_side, height_ - top);
        tile.lanes = 0;
        for (int y = 0; y < bottom; ++y)
            tile.lanes |= ((1U << right) - 1) << (y * tile_side);
        for (std::size_t k = 0; k < 3; ++k) {
            const double* const column = columns_[k].data() + left;
            const double* const row = rows_[k].data() + top;
            double* to = tile.directions.axis[k].data();
            for (int y = 0; y < tile_side; ++y)
                for (int x = 0; x < tile_side; ++x) *to++ = column[x] + row[y];
        }
    }

private:
    int width_;
    int height_;
    std::array<std::vector<double>, 3> columns_; ///< by axis
    std::array<std::vector<double>, 3> rows_;

    static int padded(int count) { return (count + tile_side - 1) / tile_side * tile_side; }
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
        Tile tile;
        for (int left = 0; left < camera.width; left += tile_side) {
            rays.set(tile, left, row * tile_side);
            work(*prober, tile);
        }
    });
    std::erase(probers, nullptr);
    return probers;
}

} // namespace shadowproof
