// Textures, and THE definition of where a texture coordinate falls among texels: the reference
// samples by it, and OpenGL's linear filter at level 0 means the same.
#pragma once

#include "scenes/image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec4.hpp>
#include <string>

namespace shadowproof {

enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

/// Texels are linear in light (or plain numbers: normals, heights), decoded once and rounded to
/// float: the same array goes to OpenGL. Channels that the file lacks are 0, a missing alpha is 1.
struct TextureImage {
    std::string name; ///< for messages: its JSON pointer
    Image<glm::vec4> texels{};
    Wrap wrap_s = Wrap::repeat; ///< along a row
    Wrap wrap_t = Wrap::repeat; ///< down the rows
    int bits = 8;               ///< per channel, in the file
    bool nearest = false;       ///< magFilter; evaluated in alpha masks alone
    bool mipmaps = false;       ///< whether minFilter asks for them
};

/// What glTF's alphaMode MASK leaves out of a surface: all places where alpha is below `least`.
/// Alpha is the texels', read at level 0 by the definition below: between texels it is
/// interpolated.
struct AlphaMask {
    std::string name;     ///< for messages: its texture's JSON pointer
    Image<float> alpha{}; ///< as the file has it, rounded to float: the same array goes to OpenGL
    Wrap wrap_s = Wrap::repeat;
    Wrap wrap_t = Wrap::repeat;
    bool nearest = false; ///< alpha is that of the texel that holds the place: floor(n * at)
    double least = 0.5;   ///< the cutoff over the alpha of the material's colour
};

/// The two texels around a coordinate along one axis, and how far it lies from the first to the
/// second, in [0, 1).
struct Taps {
    int first = 0;
    int second = 0;
    double fraction = 0;
};

/// The same as std::floor, which is a function call where the processor is not known to have an
/// instruction for it. The conversion through an integer is exact below 2^62.
inline double floor_of(double x) {
    if (!(std::abs(x) < 0x1p62)) return std::floor(x);
    const auto toward_zero = static_cast<double>(static_cast<std::int64_t>(x));
    return toward_zero > x ? toward_zero - 1 : toward_zero;
}

/// Mirrors a texel number between -1 and 2 n into [0, n).
inline int mirrored(int texel, int n) {
    if (texel < 0) return -1 - texel;
    if (texel >= 2 * n) return texel - 2 * n;
    return texel < n ? texel : 2 * n - 1 - texel;
}

/// The texture spans [0, 1]; texel i of n has its centre at (i + 0.5) / n. With x = n * at - 0.5
/// the texels are floor(x) and floor(x) + 1, each wrapped into the texture as OpenGL does
/// (OpenGL 4.5, table 8.20), the fraction x - floor(x). For repeat and mirrored_repeat `at` is
/// first brought into one period, at - floor(at) or at - 2 floor(at / 2); for clamp_to_edge x is
/// clamped to [0, n - 1]. `at` may be any finite number.
inline Taps taps_at(Wrap wrap, int texels, double at) {
    const double n = texels;
    if (wrap == Wrap::repeat) at -= floor_of(at);
    if (wrap == Wrap::mirrored_repeat) at -= 2 * floor_of(at / 2);
    double x = n * at - 0.5;
    if (wrap == Wrap::clamp_to_edge) x = std::clamp(x, 0.0, n - 1);
    const double below = floor_of(x);
    const int first = static_cast<int>(below);
    const double fraction = x - below;
    switch (wrap) {
    case Wrap::repeat:
        return {first < 0 ? texels - 1 : first, first + 1 == texels ? 0 : first + 1, fraction};
    case Wrap::mirrored_repeat:
        return {mirrored(first, texels), mirrored(first + 1, texels), fraction};
    case Wrap::clamp_to_edge:
        break;
    }
    return {first, std::min(first + 1, texels - 1), fraction};
}

/// Bilinear interpolation in double of anything stored texel by texel: a + f (b - a) along the
/// rows, then between them. Equal texels give that value unchanged.
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
