#include "compare/picture/reading/typical_colors.h"

#include <glm/geometric.hpp>

namespace shadowproof {

std::optional<Typical> typical(const std::vector<glm::dvec3>& colors) {
    if (colors.empty()) return std::nullopt;
    Typical found;
    std::vector<double> values(colors.size());
    for (int k = 0; k < 3; ++k) {
        std::transform(colors.begin(), colors.end(), values.begin(),
                       [&](const glm::dvec3& color) { return color[k]; });
        found.color[k] = median(values);
    }
    std::transform(colors.begin(), colors.end(), values.begin(),
                   [&](const glm::dvec3& color) { return glm::distance(color, found.color); });
    found.scatter = median(values);
    return found;
}

std::optional<TwoGroups> two_groups(const AngleGroup& all, double step) {
    if (all.size() < 2 * enough_pixels) return std::nullopt;
    const auto [least, greatest] =
        std::minmax_element(all.begin(), all.end(), [](const Observed* a, const Observed* b) {
            return brightness(a->value) < brightness(b->value);
        });
    double between = 0.5 * (brightness((*least)->value) + brightness((*greatest)->value));
    TwoGroups groups;
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        groups = {};
        for (const Observed* pixel : all)
            (brightness(pixel->value) < between ? groups.dark : groups.bright).push_back(pixel);
        if (groups.dark.size() < enough_pixels || groups.bright.size() < enough_pixels)
            return std::nullopt;
        const auto mean = [](const AngleGroup& group) {
            double sum = 0;
            for (const Observed* pixel : group) sum += brightness(pixel->value);
            return sum / static_cast<double>(group.size());
        };
        between = 0.5 * (mean(groups.dark) + mean(groups.bright));
    }
    const auto any = [](const Observed&) { return true; };
    const Typical low = *typical(values_of(groups.dark, any));
    const Typical high = *typical(values_of(groups.bright, any));
    const double apart = glm::distance(low.color, high.color);
    if (apart <= 4 * (low.scatter + high.scatter) || apart <= fewest_steps * step)
        return std::nullopt;
    return groups;
}

} // namespace shadowproof
