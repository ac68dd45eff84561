#include "compare/bench/bench_error.h"

namespace shadowproof {

BenchError error_of(const Frame& frame, const Comparison& comparison,
                    const Image<Visibility>& truth) {
    BenchError error{.pixels = frame.claim.pixels.size(), .differing = comparison.differing};
    for (const CauseWords& words : all_causes)
        if (const std::uint64_t pixels = pixels_of(comparison, words.cause))
            error.causes.emplace_back(words.name, pixels);
    for (std::size_t i = 0; i < comparison.cause.pixels.size(); ++i) {
        const std::uint8_t cause = comparison.cause.pixels[i];
        if (cause == no_difference || cause == static_cast<std::uint8_t>(Cause::edge)) continue;
        const Visibility seen = truth.pixels[i];
        if (frame.claim.pixels[i] == Visibility::background || seen == Visibility::background)
            continue;
        const double light = lit_share(frame, i);
        if (seen == Visibility::lit)
            error.falsely_shadowed += 1 - light;
        else
            error.falsely_lit += light;
    }
    if (const std::optional<ColorCheck>& colors = comparison.colors)
        error.color = BenchColor{colors->rmse, colors->largest, colors->percentile999};
    return error;
}

} // namespace shadowproof
