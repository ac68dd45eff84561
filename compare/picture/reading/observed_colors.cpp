#include "compare/picture/reading/observed_colors.h"

#include "compare/picture/reading/noise.h"
#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <vector>

namespace shadowproof {

namespace {

/// The bits that a picture was made with: 8, where each value of a file of 16 is one of 8.
int bits_of(const Picture& picture) {
    if (picture.bits != 16) return picture.bits;
    // Of 65535 steps each 257th is one of bytes, and others are at least a 257th of those away:
    // half of that is far more than floats round by.
    constexpr float steps = 255;
    constexpr float half_way = 0.5F / 257;
    const bool is_of_bytes =
        std::all_of(picture.values.begin(), picture.values.end(), [](float value) {
            return std::abs(value * steps - std::round(value * steps)) < half_way;
        });
    return is_of_bytes ? 8 : 16;
}

/// Of each mesh the twin's typical brightness.
std::map<std::uint32_t, double> typical_brightness(const SeenPixels& pixels, const Picture& twin) {
    std::map<std::uint32_t, std::vector<double>> all;
    for (std::size_t i = 0; i < pixels.pixels.size(); ++i)
        if (pixels.pixels[i]) all[pixels.pixels[i]->mesh].push_back(glm::length(color_at(twin, i)));
    std::map<std::uint32_t, double> typical;
    for (auto& [mesh, values] : all) {
        const auto middle = values.begin() + std::ssize(values) / 2;
        std::nth_element(values.begin(), middle, values.end());
        typical[mesh] = *middle;
    }
    return typical;
}

/// What is added to the twin's brightness where the picture's light is measured by it. By sRGB, a
/// value and 0.055 are a power of light, and so is what a surface of any colour makes of light; it
/// is in all three channels. Floats are taken for linear.
double srgb_offset(const Picture& picture) {
    constexpr double of_channel = 0.055;
    return picture.bits < 32 ? of_channel * std::sqrt(3.0) : 0;
}

} // namespace

double step_of(const Picture& picture, const Twins& twins) {
    int bits = bits_of(picture);
    for (const std::optional<Picture>* twin : {&twins.unlit, &twins.unshadowed})
        if (*twin) bits = std::min(bits, bits_of(**twin));
    return bits < 32 ? std::sqrt(3.0) / (std::exp2(bits) - 1) : 0;
}

double float_step(double brightness) {
    return brightness / 256;
}

void observe(const Picture& picture, const Picture* twin, double step, Visibility alike,
             SeenPixels& pixels) {
    constexpr double few = 8; // steps
    const double offset = srgb_offset(picture);
    std::map<std::uint32_t, double> dark;
    double noise = 0; // over fewest_steps
    if (twin != nullptr) {
        dark = typical_brightness(pixels, *twin);
        noise = least_beyond_noise(picture, *twin, alike, pixels) / fewest_steps;
    }
    for (std::size_t i = 0; i < pixels.pixels.size(); ++i) {
        if (!pixels.pixels[i]) continue;
        Observed& observed = pixels.pixels[i]->observed;
        observed.value = color_at(picture, i);
        const double own_step = std::max(
            noise,
            picture.bits < 32 ? step : std::max(step, float_step(glm::length(observed.value))));
        observed.step = static_cast<float>(own_step);
        if (twin == nullptr) continue;
        observed.value -= color_at(*twin, i);
        // What is as bright as the file tells without the light, hides it.
        if (picture.bits < 32 && glm::distance(color_at(*twin, i), glm::dvec3(1)) < few * step)
            observed.value = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
        const double typical = dark.at(pixels.pixels[i]->mesh);
        if (typical <= few * step) continue;
        // Parts of a texture may be black: as dark as the file tells beside the rest.
        const double own =
            std::max({glm::length(color_at(*twin, i)) + offset, step, float_step(typical)});
        observed.value /= own;
        observed.step = static_cast<float>(own_step / own);
        observed.is_ratio = true;
    }
}

} // namespace shadowproof
