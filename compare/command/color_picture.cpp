#include "compare/command/color_picture.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

std::uint8_t byte_of(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

double srgb_from_linear(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

} // namespace

Image<Rgb> color_picture(const Image<glm::dvec3>& linear) {
    return converted<Rgb>(linear, [](const glm::dvec3& color) {
        return Rgb{byte_of(srgb_from_linear(color.r)), byte_of(srgb_from_linear(color.g)),
                   byte_of(srgb_from_linear(color.b))};
    });
}

Image<Rgb> normal_picture(const Image<Shading>& shadings) {
    return converted<Rgb>(shadings, [](const Shading& shading) {
        const glm::dvec3& n = shading.bumped;
        if (n == glm::dvec3(0)) return Rgb{};
        return Rgb{byte_of(0.5 + 0.5 * n.x), byte_of(0.5 + 0.5 * n.y), byte_of(0.5 + 0.5 * n.z)};
    });
}

} // namespace shadowproof
