#include "scenes/bundled/author/textures.h"

#include "scenes/cube_map.h"

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

/// Calls paint(u, v) for every texel's centre and appends the result.
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

/// sRGB, from the height of a direction over the horizon, -1 to 1.
glm::dvec3 sky_and_plain(double height) {
    constexpr glm::dvec3 zenith(0.20, 0.36, 0.66);
    constexpr glm::dvec3 haze(0.83, 0.87, 0.90);
    constexpr glm::dvec3 far_plain(0.45, 0.38, 0.29);
    constexpr glm::dvec3 near_plain(0.20, 0.17, 0.15);
    const glm::dvec3 sky = glm::mix(haze, zenith, rise(-0.2, 0.9, height));
    const glm::dvec3 plain = glm::mix(far_plain, near_plain, rise(0, 0.8, -height));
    return glm::mix(plain, sky, rise(-0.02, 0.02, height));
}

/// A window on the sky, as an eye in the middle sees it.
struct Window {
    glm::dvec3 towards;
    glm::dvec2 half_size; ///< at distance 1
    glm::dvec3 color;     ///< sRGB
};

/// 1 on the window's two by two panes, 0 elsewhere.
double pane(const Window& window, const glm::dvec3& direction) {
    const glm::dvec3 ahead = glm::normalize(window.towards);
    const double distance = glm::dot(direction, ahead);
    if (distance <= 0) return 0;
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
    const glm::dvec2 at = glm::abs(glm::dvec2(glm::dot(direction, right),
                                              glm::dot(direction, glm::cross(right, ahead)))) /
                          distance;
    constexpr double soft = 0.023;
    constexpr double bar = 0.021; // half the width of the bars between panes
    const auto within = [&](int axis) {
        return rise(bar - soft, bar + soft, at[axis]) *
               (1 - rise(-soft, soft, at[axis] - window.half_size[axis]));
    };
    return within(0) * within(1);
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

namespace {

/// T. Wang's integer hash, 0 to 1: neighbours are uncorrelated.
double random_of(std::uint32_t number) {
    std::uint32_t hash = (number ^ 61U) ^ (number >> 16U);
    hash *= 9U;
    hash ^= hash >> 4U;
    hash *= 0x27d4eb2dU;
    hash ^= hash >> 15U;
    return static_cast<double>(hash & 0xffffU) / 0xffff;
}

} // namespace

Relief gravel(unsigned columns) {
    return [=](double u, double v) {
        const auto x = static_cast<std::uint32_t>(u * columns) % columns;
        const auto y = static_cast<std::uint32_t>(v * columns) % columns;
        return random_of(y * columns + x);
    };
}

Relief grooves(unsigned rows) {
    return [=](double /*u*/, double v) {
        const double at = v * rows;
        const auto row = static_cast<std::uint32_t>(at);
        const double between = rise(0, 1, at - row);
        return glm::mix(random_of(row % rows), random_of((row + 1) % rows), between);
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

Raster surroundings(unsigned face, unsigned size) {
    const Window windows[]{{{-0.83, 0.93, 0.71}, {0.31, 0.41}, {1, 0.98, 0.93}},
                           {{0.79, 0.53, 0.61}, {0.19, 0.37}, {1, 0.94, 0.80}},
                           {{-0.13, 0.67, -0.91}, {0.47, 0.23}, {0.97, 0.99, 1}}};
    return painted(size, size, 3, 8, [&](double u, double v) {
        const glm::dvec3 direction = glm::normalize(through(face, 2 * u - 1, 2 * v - 1));
        glm::dvec3 color = sky_and_plain(direction.y);
        for (const Window& window : windows)
            color = glm::mix(color, window.color, pane(window, direction));
        return color;
    });
}

Raster glossy_stripes(unsigned width, unsigned height, const Relief& relief,
                      const glm::dvec3& color, const glm::dvec3& other) {
    return painted(width, height, 4, 8, [&](double u, double v) {
        const double stripe = rise(-0.13, 0.13, std::sin(2 * std::numbers::pi * (u + 2 * v)));
        return glm::dvec4(glm::mix(color, other, stripe), 0.15 + 0.85 * relief(u, v));
    });
}

Raster masked_color(unsigned width, unsigned height, const Relief& relief,
                    const glm::dvec3& color) {
    return painted(width, height, 4, 8,
                   [&](double u, double v) { return glm::dvec4(color, relief(u, v)); });
}

} // namespace shadowproof::author
