#include "raster/traced/float_mask.h"

#include "scenes/surface/alpha_mask.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

/// As taps_at has it of doubles.
struct FloatTaps {
    int first = 0;
    int second = 0;
    float fraction = 0;
};

FloatTaps float_taps(Wrap wrap, int texels, float at, bool nearest) {
    if (wrap == Wrap::repeat) at -= std::floor(at);
    if (wrap == Wrap::mirrored_repeat) at -= 2 * std::floor(at / 2);
    float place = static_cast<float>(texels) * at;
    if (!nearest) place -= 0.5F;
    if (wrap == Wrap::clamp_to_edge)
        place = std::clamp(place, -1.0F, static_cast<float>(texels)); // further out all is alike
    const float below = std::floor(place);
    const auto first = static_cast<int>(below);
    return {wrapped(wrap, texels, first), wrapped(wrap, texels, first + 1), place - below};
}

float alpha_at(const AlphaMask& mask, const glm::vec2& at) {
    const FloatTaps s = float_taps(mask.wrap_s, mask.alpha.width, at.x, mask.nearest);
    const FloatTaps t = float_taps(mask.wrap_t, mask.alpha.height, at.y, mask.nearest);
    if (mask.nearest) return mask.alpha.at(s.first, t.first);
    const auto row = [&](int y) {
        const float a = mask.alpha.at(s.first, y);
        return a + s.fraction * (mask.alpha.at(s.second, y) - a);
    };
    const float upper = row(t.first);
    return upper + t.fraction * (row(t.second) - upper);
}

} // namespace

bool stands_at(const Scene& scene, std::uint32_t mask, std::uint32_t triangle,
               const glm::vec2& weights) {
    const glm::uvec3& t = scene.triangles[triangle];
    const glm::vec2 at = (1 - weights.x - weights.y) * scene.mask_at[t.x] +
                         weights.x * scene.mask_at[t.y] + weights.y * scene.mask_at[t.z];
    return double{alpha_at(scene.masks[mask], at)} >= scene.masks[mask].least;
}

} // namespace shadowproof
