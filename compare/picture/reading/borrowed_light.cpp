#include "compare/picture/reading/borrowed_light.h"

#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

/// The colour of a mesh where light adds that much to its shadow: between what its samples show,
/// and beyond them as the last of them shows it.
glm::dvec3 color_with(const KnownLight& known, double light) {
    const MeshLight& fit = known.fits.front();
    double below = 0;
    glm::dvec3 color_below = fit.shadow->color;
    double above = 0;
    glm::dvec3 color_above = fit.shadow->color;
    // Samples are few, and in no order of brightness where the light falls off.
    for (const Observed* const pixel : known.lit.pixels) {
        const double shown = fit.above_shadow(pixel->value);
        if (shown <= light && shown > below) {
            below = shown;
            color_below = pixel->value;
        }
        if (shown > light && (!(above > 0) || shown < above)) {
            above = shown;
            color_above = pixel->value;
        }
    }
    if (above > 0) return glm::mix(color_below, color_above, (light - below) / (above - below));
    if (!(below > 0)) return color_below;
    return glm::mix(fit.shadow->color, color_below, light / below);
}

/// Whether a pixel shows what the known mesh would show in its place; nothing where that shows no
/// light there.
bool is_alike(const KnownLight& known, const Observed& pixel, double step) {
    const MeshLight& fit = known.fits.front();
    const double light = fit.light_at(pixel).typical;
    const double least_told = fit.least_difference(step);
    return light > least_told && glm::distance(pixel.value, color_with(known, light)) <= least_told;
}

} // namespace

LitSamples lit_samples(std::span<const Observed* const> pixels) {
    std::array<std::vector<const Observed*>, angle_groups> groups;
    for (const Observed* const pixel : pixels)
        if (pixel->certainly == Visibility::lit && std::isfinite(brightness(pixel->value)) &&
            std::isfinite(pixel->lies[0].sine))
            groups[static_cast<std::size_t>(angle_group(pixel->lies[0].sine))].push_back(pixel);
    LitSamples samples;
    for (std::vector<const Observed*>& group : groups) {
        if (group.size() < enough_pixels) continue;
        const auto middle = group.begin() + static_cast<std::ptrdiff_t>(group.size() / 2);
        std::nth_element(group.begin(), middle, group.end(),
                         [](const Observed* a, const Observed* b) {
                             return brightness(a->value) < brightness(b->value);
                         });
        samples.pixels.push_back(*middle);
        samples.step = std::max(samples.step, static_cast<double>((*middle)->step));
    }
    return samples;
}

KnownLight known_light(std::vector<MeshLight> fits, std::span<const Observed* const> pixels) {
    for (MeshLight& fit : fits) fit.in_highlight = {};
    return {std::move(fits), lit_samples(pixels)};
}

std::vector<MeshLight> borrowed_light(const LitSamples& lit, std::span<const KnownLight> known) {
    if (lit.pixels.size() < 2) return {};
    const auto alike = std::find_if(known.begin(), known.end(), [&](const KnownLight& each) {
        return std::all_of(lit.pixels.begin(), lit.pixels.end(),
                           [&](const Observed* pixel) { return is_alike(each, *pixel, lit.step); });
    });
    return alike == known.end() ? std::vector<MeshLight>{} : alike->fits;
}

} // namespace shadowproof
