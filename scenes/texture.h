// Textures, and THE definition of where a texture coordinate falls among texels: the reference
// samples by it, and OpenGL's linear filter at level 0 means the same.
#pragma once

#include "scenes/image.h"

#include <cstdint>
#include <glm/vec4.hpp>
#include <string>

namespace shadowproof {

enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

/// Texels are linear in light (or plain numbers: normals, heights), decoded once and rounded to
/// float: the same array goes to OpenGL. What the file has no channel for is 0, its alpha 1.
struct TextureImage {
    std::string name; ///< for messages: its JSON pointer
    Image<glm::vec4> texels{};
    Wrap wrap_s = Wrap::repeat; ///< along a row
    Wrap wrap_t = Wrap::repeat; ///< down the rows
    int bits = 8;               ///< a channel has in the file
};

/// The two texels of one axis around a coordinate, and how far it lies from the first to the
/// second, in [0, 1).
struct Taps {
    int first = 0;
    int second = 0;
    double fraction = 0;
};

/// The texture spans [0, 1]; texel i of n has its centre at (i + 0.5) / n. With x = n * at - 0.5
/// the texels are floor(x) and floor(x) + 1, each wrapped into the texture as OpenGL does
/// (OpenGL 4.5, table 8.20), the fraction x - floor(x). For repeat and mirrored_repeat `at` is
/// first brought into one period, at - floor(at) or at - 2 floor(at / 2); for clamp_to_edge x is
/// clamped to [0, n - 1]. Any finite coordinate is welcome.
Taps taps_at(Wrap wrap, int texels, double at);

/// Bilinear interpolation in double of anything kept texel by texel: a + f (b - a) along the rows,
/// then between them. Equal texels come out unchanged.
template <class To, class From>
To sample(const Image<From>& texels, const Taps& s, const Taps& t) {
    const auto along = [&](int row) {
        const To a(texels.at(s.first, row));
        return a + s.fraction * (To(texels.at(s.second, row)) - a);
    };
    const To upper = along(t.first);
    return upper + t.fraction * (along(t.second) - upper);
}

} // namespace shadowproof
