// Which casters may be drawn at a place of a shadow map: a grid over the map's picture, by the
// boxes in which they lie there.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace shadowproof {

/// Around a caster in the picture, in texels, as far as it may be drawn but for snapping.
struct CasterBox {
    std::uint32_t caster = 0;
    glm::dvec2 low{0, 0};
    glm::dvec2 high{0, 0};
};

class CasterGrid {
public:
    CasterGrid() = default;
    /// `boxes`: in the order of casters, at most one for each. `size`: texels a side.
    CasterGrid(std::vector<CasterBox> boxes, int size);

    /// The casters, in order, whose boxes hold a place when they are `reach` larger all around.
    std::vector<std::uint32_t> around(const glm::dvec2& place, double reach) const;

private:
    /// Tiles that a box or a place meets along one axis.
    struct Tiles {
        int first = 0;
        int last = 0;
    };
    std::vector<CasterBox> boxes_;
    std::vector<std::uint32_t> large_; ///< boxes that meet many tiles
    std::vector<std::uint32_t> begin_; ///< of each tile's boxes in `of_tile_`, and the end
    std::vector<std::uint32_t> of_tile_;
    int tiles_ = 1; ///< a side
    double per_texel_ = 1;

    Tiles tiles(double low, double high) const;
};

} // namespace shadowproof
