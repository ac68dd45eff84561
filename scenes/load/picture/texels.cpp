#include "scenes/load/picture/texels.h"

#include <array>
#include <cmath>

namespace shadowproof {

namespace {

/// IEC 61966-2-1, in double.
double linear_from_srgb(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

} // namespace

Image<float> alpha_of(const Picture& picture) {
    Image<float> alpha(picture.width, picture.height, 1.0F);
    const auto channels = static_cast<std::size_t>(picture.channels);
    if (channels == 1 || channels == 3) return alpha;
    for (std::size_t i = 0; i < alpha.pixels.size(); ++i)
        alpha.pixels[i] = picture.values[i * channels + (channels == 2 ? 1 : 3)];
    return alpha;
}

Image<glm::vec4> texels_of(const Picture& picture, Encoding encoding) {
    Image<glm::vec4> texels(picture.width, picture.height);
    const auto channels = static_cast<std::size_t>(picture.channels);
    const bool has_alpha = channels == 2 || channels >= 4;
    const std::array<std::size_t, 3> color =
        channels < 3 ? std::array<std::size_t, 3>{0, 0, 0} : std::array<std::size_t, 3>{0, 1, 2};
    for (std::size_t i = 0; i < texels.pixels.size(); ++i) {
        const float* stored = picture.values.data() + i * channels;
        glm::vec4& texel = texels.pixels[i];
        for (int k = 0; k < 3; ++k) {
            const float value = stored[color[static_cast<std::size_t>(k)]];
            texel[k] =
                encoding == Encoding::plain ? value : static_cast<float>(linear_from_srgb(value));
        }
        texel.a = has_alpha ? stored[channels == 2 ? 1 : 3] : 1;
    }
    return texels;
}

} // namespace shadowproof
