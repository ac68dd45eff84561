#include "tests/sensitivity/effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace shadowproof {

namespace {

template <class Value>
std::uint64_t differing(const Image<Value>& a, const Image<Value>& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1U : 0U;
    return count;
}

/// Bit by bit, so that what is not a number equals itself.
std::uint64_t differing_rays(const TracedRays& a, const TracedRays& b) {
    const auto bits = [](const TracedPixel& pixel) {
        const FloatRay& shadow = pixel.shadow;
        std::array<std::uint32_t, 15> words{pixel.seen, pixel.shot ? 1U : 0U, pixel.occluder};
        std::size_t next = 3;
        for (const float number :
             {pixel.line.x, pixel.line.y, pixel.line.z, pixel.depth, shadow.origin.x,
              shadow.origin.y, shadow.origin.z, shadow.direction.x, shadow.direction.y,
              shadow.direction.z, shadow.near, shadow.far})
            words[next++] = std::bit_cast<std::uint32_t>(number);
        return words;
    };
    if (a.eye != b.eye || a.near != b.near || a.far != b.far || a.model.start != b.model.start ||
        a.model.distance != b.model.distance)
        return a.pixels.pixels.size();
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.pixels.pixels.size(); ++i)
        count += bits(a.pixels.pixels[i]) != bits(b.pixels.pixels[i]) ? 1U : 0U;
    return count;
}

} // namespace

Effect effect_of(const Frame& right, const Frame& faulty) {
    Effect effect;
    effect.of_map = right.mapped.has_value();
    effect.claims = differing(right.claim, faulty.claim);
    for (std::size_t light = 0; light < right.claims_before.size(); ++light)
        effect.claims += differing(right.claims_before[light], faulty.claims_before[light]);
    if (right.counted) effect.evidence = differing(right.counted->counter, faulty.counted->counter);
    for (std::size_t face = 0; right.mapped && face < right.mapped->faces.size(); ++face)
        effect.evidence += differing(right.mapped->faces[face], faulty.mapped->faces[face]);
    effect.surfaces =
        std::max(differing(right.triangle, faulty.triangle), differing(right.depth, faulty.depth));
    if (right.rays) effect.rays = differing_rays(*right.rays, *faulty.rays);
    effect.shares = differing(right.share, faulty.share);
    effect.colors = differing(right.color, faulty.color);
    for (std::size_t i = 0; i < right.color.pixels.size(); ++i)
        for (int k = 0; k < 3; ++k)
            effect.largest_color =
                std::max(effect.largest_color, 255.0 * std::abs(double{right.color.pixels[i][k]} -
                                                                faulty.color.pixels[i][k]));
    if (!right.counted) return effect;
    const auto saved = [](const Frame& frame) {
        return frame.counted->saved ? frame.counted->saved->volume_fragments : 0;
    };
    effect.figures = saved(right) != saved(faulty) ||
                     right.counted->volume_fragments != faulty.counted->volume_fragments ||
                     differing(right.counted->volumes, faulty.counted->volumes) > 0;
    return effect;
}

std::string words_of(const Effect& effect) {
    std::string words = fmt::format("{} claims, {} {}, {} surfaces", effect.claims, effect.evidence,
                                    effect.of_map ? "texels" : "counters", effect.surfaces);
    if (effect.rays > 0) words += fmt::format(", {} rays", effect.rays);
    if (effect.shares > 0) words += fmt::format(", {} shares", effect.shares);
    if (effect.colors > 0)
        words +=
            fmt::format(", {} colours by up to {:.2f}/255", effect.colors, effect.largest_color);
    if (effect.figures) words += ", figures";
    return words;
}

} // namespace shadowproof
