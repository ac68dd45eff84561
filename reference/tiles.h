// The picture cut into tiles of sixteen pixels, shared out over threads, each with its own Prober.
#pragma once

#include "reference/parallel.h"
#include "reference/visibility.h"
#include "scenes/camera.h"

#include <memory>
#include <vector>

namespace shadowproof {

/// 4 x 4 pixels, or fewer at the right and lower borders.
struct Tile {
    Lanes<int> x{};
    Lanes<int> y{};
    Lanes<glm::dvec3> directions{};
    std::uint32_t lanes = 0; ///< a bit a pixel that lies within the picture
};

inline constexpr int tile_side = 4;

inline Tile make_tile(const Camera& camera, int left, int top) {
    Tile tile;
    for (int lane = 0; lane < packet_size; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        tile.x[l] = left + lane % tile_side;
        tile.y[l] = top + lane / tile_side;
        tile.directions[l] = ray_direction(camera, tile.x[l] + 0.5, tile.y[l] + 0.5);
        if (tile.x[l] < camera.width && tile.y[l] < camera.height)
            tile.lanes |= 1U << static_cast<unsigned>(lane);
    }
    return tile;
}

/// Calls work(prober, tile) for every tile of the picture; returns the probers, one a thread that
/// worked, for their counts.
template <class Work>
std::vector<std::unique_ptr<Prober>> for_tiles(const Tracer::State& state, const Work& work) {
    const Camera& camera = state.scene->camera;
    std::vector<std::unique_ptr<Prober>> probers(static_cast<std::size_t>(state.threads));
    const int rows = (camera.height + tile_side - 1) / tile_side;
    parallel_for(rows, state.threads, [&](int row, int thread) {
        std::unique_ptr<Prober>& prober = probers[static_cast<std::size_t>(thread)];
        if (!prober) prober = std::make_unique<Prober>(state);
        for (int left = 0; left < camera.width; left += tile_side)
            work(*prober, make_tile(camera, left, row * tile_side));
    });
    std::erase(probers, nullptr);
    return probers;
}

} // namespace shadowproof
