#include "compare/picture/reading/noise.h"

#include "compare/picture/reading/typical_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

namespace shadowproof {

namespace {

/// What is left of each pixel; nothing where it is not asked.
template <class Rest>
using Rests = std::vector<std::optional<Rest>>;

double length_of(double value) {
    return std::abs(value);
}
double length_of(const glm::dvec3& value) {
    return glm::length(value);
}

/// The standard deviation of what is left, from the median of what neighbours differ by. A normal
/// number is beyond 0.6745 deviations half of the time, and noise that is the same in all channels
/// is such a number, however long. None where too few neighbours are asked.
template <class Rest>
std::optional<double> deviation(const SeenPixels& pixels, const Rests<Rest>& rests) {
    constexpr double median_of_normal = 0.6745;
    std::vector<double> apart;
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 0; x + 1 < pixels.width; ++x) {
            const std::size_t i = pixels.index(x, y);
            if (!rests[i] || !rests[i + 1]) continue;
            if (pixels.pixels[i]->mesh == pixels.pixels[i + 1]->mesh)
                apart.push_back(length_of(*rests[i] - *rests[i + 1]));
        }
    if (apart.size() < enough_pixels) return std::nullopt;
    return median(std::move(apart)) / (median_of_normal * std::numbers::sqrt2);
}

/// So many deviations the largest of the picture's pixels is off, if noise is normal: by more with
/// a chance of a tenth (Cramer, "Mathematical methods of statistics", 1946, section 28.6).
double most_deviations(const SeenPixels& pixels) {
    return std::sqrt(2 * std::log(std::max<double>(2, static_cast<double>(pixels.pixels.size()))));
}

} // namespace

double least_beyond_noise(const Picture& picture, const Twins& twins, const SeenPixels& pixels) {
    std::vector<double> lengths;
    const auto light_at = [&](std::size_t i) {
        return color_at(*twins.unshadowed, i) - color_at(*twins.unlit, i);
    };
    const auto is_of_use = [&](std::size_t i) {
        return pixels.pixels[i] && pixels.pixels[i]->observed.faces_light &&
               pixels.pixels[i]->observed.into_cone > 0 && std::isfinite(glm::length(light_at(i)));
    };
    for (std::size_t i = 0; i < pixels.pixels.size(); ++i)
        if (is_of_use(i)) lengths.push_back(glm::length(light_at(i)));
    if (lengths.empty()) return 0;
    // Half of what nearly all have at most: where light adds little, noise may choose the twin.
    const double much = 0.5 * quantile(std::move(lengths), 0.95);
    Rests<double> rests(pixels.pixels.size());
    for (std::size_t i = 0; i < pixels.pixels.size(); ++i) {
        if (!is_of_use(i)) continue;
        const glm::dvec3 light = light_at(i);
        const double length = glm::length(light);
        if (!(length > 0) || length < much) continue;
        const double along =
            glm::dot(color_at(picture, i) - color_at(*twins.unlit, i), light) / length;
        if (std::isfinite(along)) rests[i] = along < 0.5 * length ? along : along - length;
    }
    // Picture less twin has the noise of two; picture less the middle of both that of one and a
    // half, which must not reach half of the light.
    const double off_middle = std::sqrt(0.75) * deviation(pixels, rests).value_or(0);
    return 2 * most_deviations(pixels) * off_middle;
}

double least_beyond_noise(const Picture& picture, const Picture& twin, Visibility alike,
                          const SeenPixels& pixels) {
    Rests<glm::dvec3> rests(pixels.pixels.size());
    const auto deviation_where = [&](const auto& are_alike) {
        for (std::size_t i = 0; i < pixels.pixels.size(); ++i) {
            rests[i].reset();
            if (!pixels.pixels[i] || !are_alike(pixels.pixels[i]->observed)) continue;
            const glm::dvec3 rest = color_at(picture, i) - color_at(twin, i);
            if (std::isfinite(glm::length(rest))) rests[i] = rest;
        }
        return deviation(pixels, rests);
    };
    std::optional<double> noise =
        deviation_where([](const Observed& pixel) { return !pixel.faces_light; });
    if (!noise) {
        noise = deviation_where([&](const Observed& pixel) { return pixel.certainly == alike; });
        // Noise is about nothing; what is further off is light, and tells no noise.
        std::vector<glm::dvec3> asked;
        for (const std::optional<glm::dvec3>& rest : rests)
            if (rest) asked.push_back(*rest);
        if (noise && glm::length(typical(asked)->color) > *noise) noise.reset();
    }
    // Noise must not reach half of what light adds.
    return 2 * most_deviations(pixels) * noise.value_or(0);
}

} // namespace shadowproof
