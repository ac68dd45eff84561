#include "tests/sensitivity/effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

template <class Value>
std::uint64_t differing(const Image<Value>& a, const Image<Value>& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1U : 0U;
    return count;
}

} // namespace

Effect effect_of(const Frame& right, const Frame& faulty) {
    Effect effect;
    effect.of_map = right.mapped.has_value();
    effect.claims = differing(right.claim, faulty.claim);
    if (right.counted) effect.evidence = differing(right.counted->counter, faulty.counted->counter);
    for (std::size_t face = 0; right.mapped && face < right.mapped->faces.size(); ++face)
        effect.evidence += differing(right.mapped->faces[face], faulty.mapped->faces[face]);
    effect.surfaces =
        std::max(differing(right.triangle, faulty.triangle), differing(right.depth, faulty.depth));
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
    if (effect.colors > 0)
        words +=
            fmt::format(", {} colours by up to {:.2f}/255", effect.colors, effect.largest_color);
    if (effect.figures) words += ", figures";
    return words;
}

} // namespace shadowproof
