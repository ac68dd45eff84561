// What areas of a picture show, so that of one with more pixels than triangles most rays need not
// be traced: the subdivision of Warnock, "A hidden surface algorithm for computer generated
// halftone pictures", 1969. An area that nothing meets is empty; one that a triangle covers before
// all others shows it; any other is divided into four. The last of them, blocks of 8 x 8 pixels,
// are looked at pixel by pixel. All is told by doubles with bounds; what these do not tell is left
// to rays.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/camera.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace shadowproof {

/// What the pixels of a picture show at their centres.
class Areas {
public:
    /// Of a pixel that is not told.
    static constexpr std::uint32_t untold = no_triangle - 1;

    /// Whether pixels are so many that looking at areas of them may be quicker than tracing. Never
    /// where lines of sight are parallel: what is told here follows from directions.
    static bool are_worth(const Tracer& tracer, std::size_t pixels);

    /// Of a picture in which nothing is told yet.
    Areas(int width, int height);

    /// Asks for a pixel: only what is asked for is told.
    void ask(int x, int y) { ++asked_[block(x, y)]; }

    /// Tells what pictures show, on all threads: the triangles that the rays through their pixels'
    /// centres see, or no_triangle. `cameras`: one for each picture, at the eye of the tracer's
    /// scene; they may be turned and have other angles, but see between the near and far planes of
    /// that scene's camera.
    static void divide(std::span<Areas> pictures, std::span<const Camera> cameras,
                       const Tracer& tracer);

    /// What a pixel shows that was asked for.
    std::uint32_t at(int x, int y) const {
        const std::size_t i = block(x, y);
        return shows_[i] == mixed ? pixels_[i * block_pixels + in_block(x, y)] : shows_[i];
    }

private:
    static constexpr int block_side = 8; ///< pixels
    static constexpr std::size_t block_pixels = 64;
    static constexpr std::uint32_t mixed = no_triangle - 2; ///< each pixel shows its own

    /// Pixels from its left upper corner, which may reach beyond the picture.
    struct Square {
        std::size_t picture = 0;
        int x = 0;
        int y = 0;
        int side = 0;
        std::vector<std::uint32_t> among; ///< places in a list of triangles that it may show
    };
    struct Seen;

    int width_ = 0;
    int height_ = 0;
    std::size_t blocks_in_row_ = 0;
    std::vector<std::uint32_t> asked_;        ///< of blocks, by rows: how often for their pixels
    std::vector<std::uint32_t> shows_;        ///< of blocks
    std::unique_ptr<std::uint32_t[]> pixels_; ///< by blocks; only what is mixed is ever touched

    std::size_t block(int x, int y) const {
        return static_cast<std::size_t>(y / block_side) * blocks_in_row_ +
               static_cast<std::size_t>(x / block_side);
    }
    static std::size_t in_block(int x, int y) {
        return static_cast<std::size_t>(y % block_side * block_side + x % block_side);
    }
    template <class Visit>
    void for_blocks(const Square& square, const Visit& visit);
    std::vector<Square> step(const Seen& seen, Square square);
    void tell_pixels(const Seen& seen, const Square& square);
};

} // namespace shadowproof
