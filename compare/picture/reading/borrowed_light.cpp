#include "compare/picture/reading/borrowed_light.h"

#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

namespace shadowproof {

namespace {

/// The pixels of median brightness of the groups that are no outline's.
std::vector<const Observed*> medians(std::span<const Observed* const> pixels,
                                     Visibility certainly) {
    std::array<std::vector<const Observed*>, angle_groups> groups;
    for (const Observed* const pixel : pixels)
        if (pixel->certainly == certainly && std::isfinite(brightness(pixel->value)) &&
            std::isfinite(pixel->lies[0].sine))
            groups[static_cast<std::size_t>(angle_group(pixel->lies[0].sine))].push_back(pixel);
    std::vector<const Observed*> found;
    for (std::vector<const Observed*>& group : groups) {
        if (group.size() < enough_pixels) continue;
        const auto middle = group.begin() + static_cast<std::ptrdiff_t>(group.size() / 2);
        std::nth_element(group.begin(), middle, group.end(),
                         [](const Observed* a, const Observed* b) {
                             return brightness(a->value) < brightness(b->value);
                         });
        found.push_back(*middle);
    }
    return found;
}

/// The colour of a mesh where light adds that much to its shadow: between what its samples show,
/// and beyond them as the last of them shows it. Nothing where they show no light.
std::optional<glm::dvec3> color_with(const KnownLight& known, double light) {
    const glm::dvec3& shadow = known.fit.shadow->color;
    double below = 0;
    glm::dvec3 color_below = shadow;
    double above = std::numeric_limits<double>::infinity();
    glm::dvec3 color_above = shadow;
    // Samples are few, and in no order of brightness where the light falls off.
    for (const Observed* const pixel : known.shown.lit) {
        const double shown = known.fit.above_shadow(pixel->value);
        if (!(shown > known.fit.least_difference(pixel->step))) continue;
        if (shown <= light && shown > below) {
            below = shown;
            color_below = pixel->value;
        }
        if (shown > light && shown < above) {
            above = shown;
            color_above = pixel->value;
        }
    }
    if (std::isfinite(above))
        return glm::mix(color_below, color_above, (light - below) / (above - below));
    if (!(below > 0)) return std::nullopt;
    return glm::mix(shadow, color_below, light / below);
}

/// Whether a pixel shows the light that the known mesh would show in its place. Not where that is
/// too little to be told.
bool shows_light(const KnownLight& known, const Observed& pixel, double step) {
    const double least_told = known.fit.least_difference(step);
    const double light = known.fit.light_at(pixel).typical;
    if (!(light > least_told)) return false;
    const std::optional<glm::dvec3> color = color_with(known, light);
    return color && glm::distance(pixel.value, *color) <= least_told;
}

bool shows_shadow(const KnownLight& known, const Observed& pixel, double step) {
    return std::abs(known.fit.above_shadow(pixel.value)) <= known.fit.least_difference(step);
}

bool is_alike(const KnownLight& known, const MeshSamples& shown) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    for (const Observed* const pixel : shown.lit) {
        if (!shows_light(known, *pixel, shown.step)) return false;
        const double light = known.fit.light_at(*pixel).typical;
        least = std::min(least, light);
        most = std::max(most, light);
    }
    return most - least > 4 * known.fit.least_difference(shown.step) &&
           std::ranges::all_of(shown.shadowed, [&](const Observed* pixel) {
               return shows_shadow(known, *pixel, shown.step) ||
                      shows_light(known, *pixel, shown.step);
           });
}

} // namespace

MeshSamples mesh_samples(std::span<const Observed* const> pixels) {
    MeshSamples samples{medians(pixels, Visibility::lit), medians(pixels, Visibility::shadowed), 0};
    for (const std::vector<const Observed*>* const group : {&samples.lit, &samples.shadowed})
        for (const Observed* const pixel : *group)
            samples.step = std::max(samples.step, static_cast<double>(pixel->step));
    return samples;
}

KnownLight known_light(MeshLight fit, std::span<const Observed* const> pixels) {
    fit.in_highlight = {};
    return {std::move(fit), mesh_samples(pixels)};
}

std::vector<MeshLight> borrowed_light(const MeshSamples& shown, std::span<const KnownLight> known) {
    const auto alike =
        std::ranges::find_if(known, [&](const KnownLight& each) { return is_alike(each, shown); });
    if (alike == known.end()) return {};
    std::vector<MeshLight> fits{alike->fit};
    // Nothing tells by which normals the other mesh is shaded: it is dark only by all of them.
    for (std::size_t normals = 0; normals < all_normals_by.size(); ++normals) {
        if (normals == alike->fit.normals) continue;
        fits.push_back(alike->fit);
        fits.back().normals = normals;
    }
    return fits;
}

} // namespace shadowproof
