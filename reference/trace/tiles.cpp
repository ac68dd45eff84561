#include "reference/trace/tiles.h"

// Highway compiles what follows once for each instruction set, then chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/trace/tiles.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shadowproof::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void add(const Vectors& columns, const Vectors& rows, Vectors& sum) {
    constexpr hn::CappedTag<double, packet_size> doubles;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < packet_size; i += hn::Lanes(doubles))
            hn::Store(hn::Add(hn::Load(doubles, columns.axis[axis].data() + i),
                              hn::Load(doubles, rows.axis[axis].data() + i)),
                      doubles, sum.axis[axis].data() + i);
}

} // namespace
} // namespace shadowproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shadowproof {

namespace {
HWY_EXPORT(add);
} // namespace

PixelRays::PixelRays(const Camera& camera) : width_(camera.width), height_(camera.height) {
    const auto tiles = [](int pixels) {
        return static_cast<std::size_t>((pixels + tile_side - 1) / tile_side);
    };
    columns_.resize(tiles(width_));
    rows_.resize(tiles(height_));
    const auto center = [](std::size_t tile, std::size_t within, int pixels) {
        return std::min(static_cast<int>(tile * tile_side + within), pixels - 1) + 0.5;
    };
    for (std::size_t tile = 0; tile < columns_.size(); ++tile)
        for (std::size_t lane = 0; lane < packet_size; ++lane)
            columns_[tile].set(lane, sight_column(camera, center(tile, lane % tile_side, width_)));
    for (std::size_t tile = 0; tile < rows_.size(); ++tile)
        for (std::size_t lane = 0; lane < packet_size; ++lane)
            rows_[tile].set(lane, sight_row(camera, center(tile, lane / tile_side, height_)));
}

void PixelRays::set(Tile& tile, int left, int top) const {
    tile.left = left;
    tile.top = top;
    const int right = std::min(tile_side, width_ - left);
    const int bottom = std::min(tile_side, height_ - top);
    tile.lanes = 0;
    for (int y = 0; y < bottom; ++y) tile.lanes |= ((1U << right) - 1) << (y * tile_side);
    HWY_DYNAMIC_DISPATCH(add)
    (columns_[static_cast<std::size_t>(left / tile_side)],
     rows_[static_cast<std::size_t>(top / tile_side)], tile.lines);
}

} // namespace shadowproof
#endif
