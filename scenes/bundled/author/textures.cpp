#include "scenes/bundled/author/textures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace shadowproof::author {

namespace {

/// 0 below `low`, 1 above `high`, smooth between.
double rise(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// Distance from a point to a straight line between two.
double distance_to(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double t = std::clamp(glm::dot(point - a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(point, a + t * along);
}

std::uint16_t stored(double value, unsigned bits) {
    const double most = (1U << bits) - 1U;
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * most));
}

/// Calls paint(u, v) for every texel's centre; what it returns is appended.
template <class Paint>
Raster painted(unsigned width, unsigned height, unsigned channels, unsigned bits,
               const Paint& paint) {
    Raster raster{width, height, channels, bits, {}};
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x) {
            const auto color = paint((x + 0.5) / width, (y + 0.5) / height);
            for (unsigned k = 0; k < channels; ++k)
                raster.values.push_back(stored(color[static_cast<int>(k)], bits));
        }
    return raster;
}

} // namespace

Relief bumps(unsigned columns, unsigned rows) {
    return [=](double u, double v) {
        const double x = std::sin(std::numbers::pi * columns * u);
        const double y = std::sin(std::numbers::pi * rows * v);
        return x * x * y * y;
    };
}

Relief hook() {
    return [](double u, double v) {
        const glm::dvec2 at(u, v);
        const double shaft = distance_to(at, {0.31, 0.22}, {0.43, 0.73});
        const double barb = distance_to(at, {0.43, 0.73}, {0.71, 0.57});
        double nearest = std::min(shaft, barb);
        for (const glm::dvec2& dot : {glm::dvec2(0.69, 0.27), {0.83, 0.39}, {0.17, 0.83}})
            nearest = std::min(nearest, glm::distance(at, dot));
        return 1 - rise(0.023, 0.087, nearest);
    };
}

Relief ripples() {
    return [](double u, double v) {
        const double from_middle = std::hypot(u - 0.5, v - 0.5);
        const double wave = 0.5 + 0.5 * std::cos(2 * std::numbers::pi * 6.5 * from_middle);
        return 0.7 * wave * (1 - rise(0.31, 0.47, from_middle)) +
               0.3 * rise(0.43, 0.49, u + 0.2 * v);
    };
}

Relief gravel(unsigned columns) {
    return [=](double u, double v) {
        const auto x = static_cast<std::uint32_t>(u * columns) % columns;
        const auto y = static_cast<std::uint32_t>(v * columns) % columns;
        // T. Wang's integer hash: neighbours have nothing in common.
        std::uint32_t hash = y * columns + x;
        hash = (hash ^ 61U) ^ (hash >> 16U);
        hash *= 9U;
        hash ^= hash >> 4U;
        hash *= 0x27d4eb2dU;
        hash ^= hash >> 15U;
        return static_cast<double>(hash & 0xffffU) / 0xffff;
    };
}

Raster height_map(unsigned width, unsigned height, const Relief& relief) {
    return painted(width, height, 1, 16,
                   [&](double u, double v) { return glm::dvec3(relief(u, v)); });
}

Raster normal_map(unsigned width, unsigned height, const Relief& relief, double scale) {
    const double du = 1.0 / width;
    const double dv = 1.0 / height;
    const auto around = [&](double u, double v) {
        return relief(u - std::floor(u), v - std::floor(v));
    };
    return painted(width, height, 3, 8, [&](double u, double v) {
        const double to_right = (around(u + du, v) - around(u - du, v)) / 2;
        const double down = (around(u, v + dv) - around(u, v - dv)) / 2;
        return glm::normalize(glm::dvec3(-scale * to_right, scale * down, 1)) * 0.5 + 0.5;
    });
}

Raster glossy_stripes(unsigned width, unsigned height, const Relief& relief,
                      const glm::dvec3& color, const glm::dvec3& other) {
    return painted(width, height, 4, 8, [&](double u, double v) {
        const double stripe = rise(-0.13, 0.13, std::sin(2 * std::numbers::pi * (u + 2 * v)));
        return glm::dvec4(glm::mix(color, other, stripe), 0.15 + 0.85 * relief(u, v));
    });
}

} // namespace shadowproof::author
