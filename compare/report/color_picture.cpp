#include "compare/report/color_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace shadowproof {

namespace {

std::uint8_t byte_of(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

/// IEC 61966-2-1, whose numbers these are: a line near black, a power above.
double srgb_from_linear(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

Rgb pixel_of(const glm::dvec3& linear) {
    return {byte_of(srgb_from_linear(linear.r)), byte_of(srgb_from_linear(linear.g)),
            byte_of(srgb_from_linear(linear.b))};
}

/// Of a unit vector; 0 is black.
Rgb direction_color(const glm::dvec3& v) {
    if (v == glm::dvec3(0)) return {};
    return {byte_of(0.5 + 0.5 * v.x), byte_of(0.5 + 0.5 * v.y), byte_of(0.5 + 0.5 * v.z)};
}

} // namespace

Image<Rgb> color_picture(const Image<glm::dvec3>& linear) {
    return converted<Rgb>(linear, pixel_of);
}

Image<Rgb> color_picture(const Image<glm::vec3>& linear) {
    return converted<Rgb>(linear, [](const glm::vec3& color) { return pixel_of(color); });
}

Image<Rgb> normal_picture(const Image<Shading>& shadings) {
    return converted<Rgb>(shadings,
                          [](const Shading& shading) { return direction_color(shading.bumped); });
}

Image<Rgb> tangent_picture(const Image<Shading>& shadings) {
    return converted<Rgb>(shadings,
                          [](const Shading& shading) { return direction_color(shading.tangent); });
}

Image<Rgb> tangent_space_picture(const Image<Shading>& shadings, glm::dvec3 Shading::*direction) {
    return converted<Rgb>(shadings, [&](const Shading& shading) {
        if (shading.tangent == glm::dvec3(0)) return Rgb{};
        const glm::dvec3 front = shading.side * shading.normal;
        const glm::dvec3 bitangent = shading.hand * glm::cross(front, shading.tangent);
        const glm::dvec3 v = shading.side * (shading.*direction);
        return direction_color(
            {glm::dot(v, shading.tangent), glm::dot(v, bitangent), glm::dot(v, front)});
    });
}

} // namespace shadowproof
