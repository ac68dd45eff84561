#include "scenes/surface/alpha_mask.h"

#include "scenes/roundoff.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

/// Where a rectangle lies along one axis of the texture: in texels from the first one's centre, or,
/// where the nearest is read, from its border.
struct Reach {
    double low = 0;
    double high = 0;
    bool is_few() const { return high - low < most_texels && std::abs(low) + std::abs(high) < far; }

private:
    static constexpr double most_texels = 16;
    static constexpr double far = 0x1p40; ///< here doubles still tell a thousandth of a texel
};

/// Two roundings, of the product and the difference.
Reach reach(const AlphaMask& mask, int texels, double low, double high) {
    const double half = mask.nearest ? 0 : 0.5;
    const auto at = [&](double coordinate, double outwards) {
        const double place = texels * coordinate;
        return (place - half) + outwards * 4 * double_roundoff * (std::abs(place) + 1);
    };
    return {at(low, -1), at(high, 1)};
}

float texel_at(const AlphaMask& mask, std::int64_t x, std::int64_t y) {
    return mask.alpha.at(wrapped(mask.wrap_s, mask.alpha.width, x),
                         wrapped(mask.wrap_t, mask.alpha.height, y));
}

void include(AlphaRange& range, double alpha) {
    range.low = std::min(range.low, alpha);
    range.high = std::max(range.high, alpha);
}

/// The part of the rectangle between four texels' centres, the first of which is (x, y). There
/// alpha is linear along both axes, and so extreme at corners. Rounded are, three times, a
/// difference, a product and a sum of numbers up to 1; of equal texels nothing is.
void include_between(const AlphaMask& mask, std::int64_t x, std::int64_t y, const Reach& along,
                     const Reach& down, AlphaRange& range) {
    const auto part = [](double place, std::int64_t first) {
        return std::clamp(place - static_cast<double>(first), 0.0, 1.0);
    };
    const double a = texel_at(mask, x, y);
    const double b = texel_at(mask, x + 1, y);
    const double c = texel_at(mask, x, y + 1);
    const double d = texel_at(mask, x + 1, y + 1);
    const double error = a == b && a == c && a == d ? 0 : 16 * double_roundoff;
    for (const double s : {part(along.low, x), part(along.high, x)})
        for (const double t : {part(down.low, y), part(down.high, y)}) {
            const double upper = a + s * (b - a);
            const double lower = c + s * (d - c);
            const double between = upper + t * (lower - upper);
            include(range, between - error);
            include(range, between + error);
        }
}

} // namespace

int wrapped(Wrap wrap, int texels, std::int64_t texel) {
    if (wrap == Wrap::clamp_to_edge)
        return static_cast<int>(std::clamp<std::int64_t>(texel, 0, texels - 1));
    const std::int64_t period = wrap == Wrap::repeat ? texels : 2 * std::int64_t{texels};
    const std::int64_t within = (texel % period + period) % period;
    return mirrored(static_cast<int>(within), texels);
}

AlphaRange alpha_range(const AlphaMask& mask, const glm::dvec2& low, const glm::dvec2& high) {
    const Reach along = reach(mask, mask.alpha.width, low.x, high.x);
    const Reach down = reach(mask, mask.alpha.height, low.y, high.y);
    if (!along.is_few() || !down.is_few()) return {};
    AlphaRange range{2, -1};
    const auto first = [](const Reach& r) { return static_cast<std::int64_t>(std::floor(r.low)); };
    const auto last = [](const Reach& r) { return static_cast<std::int64_t>(std::floor(r.high)); };
    for (std::int64_t y = first(down); y <= last(down); ++y)
        for (std::int64_t x = first(along); x <= last(along); ++x) {
            if (mask.nearest)
                include(range, texel_at(mask, x, y));
            else
                include_between(mask, x, y, along, down, range);
        }
    return range;
}

Scene without_masks(Scene scene) {
    scene.masks.clear();
    scene.mask_at.clear();
    for (Material& material : scene.materials) material.mask = no_mask;
    return scene;
}

std::array<glm::dvec2, 3> mask_coordinates(const Scene& scene, std::uint32_t triangle) {
    const glm::uvec3& t = scene.triangles[triangle];
    return {scene.mask_at[t.x], scene.mask_at[t.y], scene.mask_at[t.z]};
}

} // namespace shadowproof
