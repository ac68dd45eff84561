// The picture divided into tiles of sixteen pixels, which are distributed over threads, each with
// its own Prober.
#pragma once

#include "reference/parallel.h"
#include "reference/trace/visibility.h"
#include "scenes/camera.h"
#include "scenes/image.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace shadowproof {

inline constexpr int tile_side = 4;

/// 4 x 4 pixels, row by row, or fewer at the right and lower borders.
struct Tile {
    int left = 0;
    int top = 0;
    std::uint32_t lanes = 0; ///< one bit per pixel that lies within the picture
    Vectors lines;           ///< of sight

    int x(std::size_t lane) const { return left + static_cast<int>(lane) % tile_side; }
    int y(std::size_t lane) const { return top + static_cast<int>(lane) / tile_side; }

    /// Into the tile's pixels of a picture.
    template <class T>
    void copy(const Lanes<T>& values, Image<T>& picture) const {
        const int width = std::min(tile_side, picture.width - left);
        const int height = std::min(tile_side, picture.height - top);
        for (int y = 0; y < height; ++y) {
            const T* const from = values.data() + std::ptrdiff_t{y} * tile_side;
            T* const to = picture.pixels.data() + picture.index(left, top + y);
            if (width == tile_side)
                std::copy_n(from, tile_side, to); // without a call
            else
                std::copy_n(from, width, to);
        }
    }
};

/// The lines of sight of a picture's pixels, equal to line_of_sight, from one vector per column and
/// one per row. Beyond the picture they are those of its last column and row.
class PixelRays {
public:
    explicit PixelRays(const Camera& camera);

    void set(Tile& tile, int left, int top) const;

private:
    int width_;
    int height_;
    std::vector<Vectors> columns_; ///< of each column of tiles, lane by lane
    std::vector<Vectors> rows_;    ///< of each row of tiles
};

/// Pixels that are traced from left to right together, so that neighbours come soon after each
/// other, and find again what the first one needed.
inline constexpr int strip_height = 4 * tile_side;

/// Calls work(prober, tile) for every tile of the picture. Returns the probers, one per thread that
/// worked, for their counts.
template <class Work>
std::vector<std::unique_ptr<Prober>> for_tiles(const Tracer::State& state, const Work& work,
                                               Filters filters = Filters::on) {
    const Camera& camera = state.scene->camera;
    const PixelRays rays(camera);
    std::vector<std::unique_ptr<Prober>> probers(static_cast<std::size_t>(state.threads));
    const int strips = (camera.height + strip_height - 1) / strip_height;
    parallel_for(strips, state.threads, [&](int strip, int thread) {
        std::unique_ptr<Prober>& prober = probers[static_cast<std::size_t>(thread)];
        if (!prober) prober = std::make_unique<Prober>(state, filters);
        const int end = std::min(camera.height, (strip + 1) * strip_height);
        Tile tile;
        for (int left = 0; left < camera.width; left += tile_side)
            for (int top = strip * strip_height; top < end; top += tile_side) {
                rays.set(tile, left, top);
                work(*prober, tile);
            }
    });
    std::erase(probers, nullptr);
    return probers;
}

} // namespace shadowproof
