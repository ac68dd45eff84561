#include "compare/picture/texel_planes.h"

#include "scenes/shadow_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

namespace shadowproof {

namespace {

TexelPlane plane_of(const LightAxes& axes, const Wave& wave) {
    const auto turns = [](const std::complex<double>& mean) {
        return std::arg(mean) / (2 * std::numbers::pi);
    };
    return {axes, 1 / wave.frequency, {turns(wave.mean[0]), turns(wave.mean[1])}};
}

/// Steps with a border between their pixels.
std::size_t bordered(const ShadowSteps& steps, const TexelPlane& plane) {
    const double texels = 1 / plane.side;
    std::size_t count = 0;
    for (const ShadowStep& step : steps.steps) {
        const glm::dvec2 low = (step.middle - 0.5 * step.apart) * texels - plane.corner;
        const glm::dvec2 high = low + step.apart * texels;
        const bool between =
            std::floor(low.x) < std::floor(high.x) || std::floor(low.y) < std::floor(high.y);
        count += between ? 1 : 0;
    }
    return count;
}

/// Moves the texels as long as more steps have a border, and where `and_side`, makes them wider or
/// narrower about the middle of all steps.
void settle(const ShadowSteps& steps, TexelPlane& plane, bool and_side) {
    constexpr int halvings = 6;
    const glm::dvec2 middle = 0.5 * (steps.low + steps.high);
    const double half = 0.5 * std::max(steps.high.x - steps.low.x, steps.high.y - steps.low.y);
    std::size_t best = bordered(steps, plane);
    double step = 0.25; // texels, at the furthest step where it is the side that changes
    for (int i = 0; i < halvings; ++i, step /= 2)
        for (int axis = 0; axis < (and_side ? 3 : 2); ++axis)
            for (const double sign : {-1.0, 1.0}) {
                const TexelPlane tried = axis == 2 ? widened(plane, middle, half, sign * step)
                                                   : moved(plane, axis, sign * step);
                const std::size_t count = bordered(steps, tried);
                if (count <= best) continue;
                best = count;
                plane = tried;
                break;
            }
}

/// The middle of a light's map: a spot's axis; of a directional light where the file has it, or the
/// world's origin. An even number of texels has a border there.
std::vector<glm::dvec2> usual_middles(const Light& light, const LightAxes& axes) {
    if (light.kind == Light::Kind::spot) return {{0, 0}};
    const glm::dvec2 own(place_from_light(light, axes, light.position));
    const glm::dvec2 origin(place_from_light(light, axes, glm::dvec3(0)));
    if (own == origin) return {own};
    return {own, origin};
}

/// Of each wave the part that has a crest at a place.
std::vector<Wave> with_crests_at(const glm::dvec2& place, std::vector<Wave> waves) {
    for (Wave& wave : waves)
        for (int k = 0; k < 2; ++k) {
            std::complex<double>& mean = wave.mean[static_cast<std::size_t>(k)];
            const auto crest = std::polar(1.0, 2 * std::numbers::pi * wave.frequency * place[k]);
            mean = std::max((mean * std::conj(crest)).real(), 0.0) * crest;
        }
    return waves;
}

Wave strongest(const std::vector<Wave>& waves) {
    return *std::max_element(waves.begin(), waves.end(),
                             [](const Wave& a, const Wave& b) { return a.power() < b.power(); });
}

/// Of a measured side, as an end lies between two pixels.
constexpr double measured_to = 0.01;

/// Half the side of a square around a middle that ends where the frustum does; nothing where the
/// middle is not in it, or its ends are not equally far away.
std::optional<double> half_side_around(const glm::dvec2& middle, const LightFrustum& frustum) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    for (int axis = 0; axis < 2; ++axis) {
        if (!(frustum.low[axis] < middle[axis] && middle[axis] < frustum.high[axis]))
            return std::nullopt;
        for (const double end : {frustum.low[axis], frustum.high[axis]}) {
            const double half = std::abs(end - middle[axis]);
            if (!std::isfinite(half)) continue;
            least = std::min(least, half);
            most = std::max(most, half);
        }
    }
    if (most == 0 || most - least > measured_to * most) return std::nullopt;
    return (least + most) / 2;
}

/// As people give lengths.
double in_two_digits(double length) {
    const double digit = std::pow(10, std::floor(std::log10(length)) - 1);
    return std::round(length / digit) * digit;
}

} // namespace

TexelPlane moved(TexelPlane plane, int axis, double texels) {
    plane.corner[axis] += texels;
    return plane;
}

TexelPlane widened(TexelPlane plane, const glm::dvec2& held, double away, double texels) {
    const glm::dvec2 place = held / plane.side - plane.corner;
    plane.side *= std::max(1 + texels * plane.side / away, 0.5);
    plane.corner = held / plane.side - place;
    return plane;
}

std::vector<MapSquare> usual_squares(const Scene& scene) {
    constexpr double of_three = 10;
    const Light& light = chosen_light(scene);
    if (light.kind == Light::Kind::spot) {
        std::vector<MapSquare> squares;
        const double half = half_side_of_spot(light);
        for (const LightAxes& axes : usual_axes(light))
            squares.push_back({axes, 2 * half, glm::dvec2(-half), false});
        return squares;
    }
    MapModel fitted{.shape = MapModel::Shape::sun};
    fit_sun(fitted, scene);
    const Camera camera = map_camera(light, fitted, 0);
    std::vector<MapSquare> squares{
        {{camera.right, camera.up, camera.forward},
         2 * fitted.half_side,
         glm::dvec2(glm::dot(camera.right, fitted.eye), glm::dot(camera.up, fitted.eye)) -
             fitted.half_side,
         false}};
    const double side = of_three / scene.unit;
    for (const LightAxes& axes : usual_axes(light)) {
        squares.push_back({axes, side, std::nullopt, false});
        for (const glm::dvec2& middle : usual_middles(light, axes))
            squares.push_back({axes, side, middle - side / 2, false});
    }
    return squares;
}

std::vector<MapSquare> measured_squares(const LightFrustum& frustum, const Light& light) {
    std::vector<MapSquare> squares;
    for (int axis = 0; axis < 2; ++axis) {
        const double side = frustum.high[axis] - frustum.low[axis];
        if (std::isfinite(side)) squares.push_back({frustum.axes, side, std::nullopt, true});
    }
    if (light.kind != Light::Kind::directional) return squares;
    for (const glm::dvec2& middle : usual_middles(light, frustum.axes)) {
        const std::optional<double> half = half_side_around(middle, frustum);
        if (!half) continue;
        squares.push_back({frustum.axes, 2 * *half, middle - *half, true});
        const double rounded = in_two_digits(*half);
        if (std::abs(rounded - *half) < measured_to * *half)
            squares.push_back({frustum.axes, 2 * rounded, middle - rounded, false});
    }
    return squares;
}

TexelPlane divided(const ShadowSteps& steps, const MapSquare& square, int across) {
    const double side = square.side / across;
    constexpr double most_texels = 0x1p40; // from the middle, where places have parts of them
    if (square.low &&
        std::max(std::abs(square.low->x), std::abs(square.low->y)) < most_texels * side)
        return {square.axes, side, *square.low / side, !square.is_measured};
    TexelPlane plane = plane_of(square.axes, waves_of(steps, 1 / side, 0, 1).front());
    plane.side = side;
    settle(steps, plane, square.is_measured);
    return plane;
}

std::vector<TexelPlane> proposed_planes(const ShadowSteps& steps, const Light& light) {
    constexpr std::size_t most = 24;
    constexpr std::size_t most_around = 12; // a middle
    constexpr double fewest = 8;            // texels over all steps
    constexpr double coarse = 4;            // waves told apart over all steps
    constexpr int most_waves = 1 << 15;
    const glm::dvec2 size = steps.high - steps.low;
    const double extent = std::max(size.x, size.y);
    std::vector<TexelPlane> planes;
    if (steps.steps.empty() || !(extent > 0)) return planes;
    const double first = fewest / extent;
    const double step = 1 / (coarse * extent);
    const double last = 1 / steps.apart; // finer texels are no steps of pixels
    const int count = static_cast<int>(std::min((last - first) / step, double{most_waves}));
    if (count < 3) return planes;
    const std::vector<Wave> waves = waves_of(steps, first, step, count);
    const auto around = [&](const Wave& peak) {
        constexpr int finer = 32;
        return waves_of(steps, peak.frequency - step, 2 * step / finer, finer + 1);
    };
    for (const Wave& peak : peaks(waves, most)) {
        planes.push_back(plane_of(steps.axes, strongest(around(peak))));
        settle(steps, planes.back(), true);
    }
    for (const glm::dvec2& middle : usual_middles(light, steps.axes))
        for (const Wave& peak : peaks(with_crests_at(middle, waves), most_around))
            planes.push_back(plane_of(steps.axes, strongest(with_crests_at(middle, around(peak)))));
    return planes;
}

} // namespace shadowproof
