#include "compare/maps/caster_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shadowproof {

namespace {

constexpr int texels_per_tile = 16;
constexpr int most_tiles = 64; // a side
/// A box that meets more is kept apart, so that a tile's entry costs no more than looking at it.
constexpr int few_tiles = 16;

} // namespace

CasterGrid::Tiles CasterGrid::tiles(double low, double high) const {
    const auto tile = [&](double at) {
        return static_cast<int>(std::clamp(std::floor(at * per_texel_), 0.0, tiles_ - 1.0));
    };
    return {tile(low), tile(high)};
}

CasterGrid::CasterGrid(std::vector<CasterBox> boxes, int size)
    : boxes_(std::move(boxes)), tiles_(std::clamp(size / texels_per_tile, 1, most_tiles)),
      per_texel_(static_cast<double>(tiles_) / size) {
    const auto for_tiles = [&](const CasterBox& box, const auto& visit) {
        const Tiles columns = tiles(box.low.x, box.high.x);
        const Tiles rows = tiles(box.low.y, box.high.y);
        if ((columns.last - columns.first + 1) * (rows.last - rows.first + 1) > few_tiles)
            return false;
        for (int row = rows.first; row <= rows.last; ++row)
            for (int column = columns.first; column <= columns.last; ++column)
                visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles_) +
                      static_cast<std::size_t>(column));
        return true;
    };
    begin_.assign(static_cast<std::size_t>(tiles_) * static_cast<std::size_t>(tiles_) + 1, 0);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        if (!for_tiles(boxes_[i], [&](std::size_t tile) { ++begin_[tile + 1]; }))
            large_.push_back(i);
    for (std::size_t tile = 1; tile < begin_.size(); ++tile) begin_[tile] += begin_[tile - 1];
    of_tile_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        for_tiles(boxes_[i], [&](std::size_t tile) { of_tile_[next[tile]++] = i; });
}

std::vector<std::uint32_t> CasterGrid::around(const glm::dvec2& place, double reach) const {
    std::vector<std::uint32_t> casters;
    const auto add = [&](std::span<const std::uint32_t> of) {
        for (const std::uint32_t i : of) {
            const CasterBox& box = boxes_[i];
            if (place.x >= box.low.x - reach && place.y >= box.low.y - reach &&
                place.x <= box.high.x + reach && place.y <= box.high.y + reach)
                casters.push_back(box.caster);
        }
    };
    if (boxes_.empty()) return casters;
    add(large_);
    const Tiles columns = tiles(place.x - reach, place.x + reach);
    const Tiles rows = tiles(place.y - reach, place.y + reach);
    for (int row = rows.first; row <= rows.last; ++row)
        for (int column = columns.first; column <= columns.last; ++column) {
            const auto tile = static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles_) +
                              static_cast<std::size_t>(column);
            add(std::span(of_tile_).subspan(begin_[tile], begin_[tile + 1] - begin_[tile]));
        }
    std::ranges::sort(casters);
    const auto repeated = std::ranges::unique(casters);
    casters.erase(repeated.begin(), repeated.end());
    return casters;
}

} // namespace shadowproof
