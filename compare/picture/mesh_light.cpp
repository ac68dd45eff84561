#include "compare/picture/mesh_light.h"

#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace shadowproof {

namespace {

constexpr std::size_t enough = 16; // not a few pixels of an outline

/// Of the file's integers. A difference of two colours is off by one of them at most, and is asked
/// whether it is more than half of what light adds: with four, that may be off by a quarter.
constexpr double fewest_steps = 4;

/// What a share of the values do not reach.
template <class T>
T quantile(std::vector<T> values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

template <class T>
T median(std::vector<T> values) {
    return quantile(std::move(values), 0.5);
}

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

double brightness(const glm::dvec3& color) {
    return color.x + color.y + color.z;
}

/// Pixels that face the light at about one angle.
using AngleGroup = std::vector<const Observed*>;
using AngleGroups = std::array<AngleGroup, angle_groups>;

template <class Keep>
std::vector<glm::dvec3> values_of(const AngleGroup& group, const Keep& keep) {
    std::vector<glm::dvec3> values;
    for (const Observed* pixel : group)
        if (keep(*pixel)) values.push_back(pixel->value);
    return values;
}

struct TwoGroups {
    AngleGroup dark;
    AngleGroup bright;
};

/// The two groups into which colours fall by their brightness (2-means); nothing where they are
/// one. Of colours that are spread evenly, the groups' means lie twice as far apart as the colours
/// of both lie from their medians; groups that are two lie twice as far again.
std::optional<TwoGroups> two_groups(const AngleGroup& all, double step) {
    if (all.size() < 2 * enough) return std::nullopt;
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
        if (groups.dark.size() < enough || groups.bright.size() < enough) return std::nullopt;
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

/// The sine that a share of the pixels do not reach.
double sine_at(const AngleGroup& pixels, double share) {
    std::vector<float> sines;
    for (const Observed* pixel : pixels) sines.push_back(pixel->sine);
    return quantile(std::move(sines), share);
}

/// The darker of two groups of pixels, but where the light only falls on it at a lower angle.
std::vector<glm::dvec3> darker_group(const AngleGroup& group, double step) {
    const std::optional<TwoGroups> two = two_groups(group, step);
    if (!two || sine_at(two->dark, 0.5) < sine_at(two->bright, 0.25)) return {};
    return values_of(two->dark, [](const Observed&) { return true; });
}

/// The typical colour of pixels certainly in shadow, of the angles at which the picture shows them
/// darker than lit ones.
std::optional<Typical> true_shadow(std::span<const AngleGroup> groups, double step) {
    std::vector<glm::dvec3> all;
    for (const AngleGroup& group : groups) {
        const auto dark = values_of(
            group, [](const Observed& pixel) { return pixel.certainly == Visibility::shadowed; });
        const auto bright = values_of(
            group, [](const Observed& pixel) { return pixel.certainly == Visibility::lit; });
        if (dark.size() < enough || bright.size() < enough) continue;
        const Typical shadow = *typical(dark);
        const glm::dvec3 lit = typical(bright)->color;
        if (brightness(lit) > brightness(shadow.color) &&
            glm::distance(lit, shadow.color) > fewest_steps * step + 4 * shadow.scatter)
            all.insert(all.end(), dark.begin(), dark.end());
    }
    return typical(all);
}

/// The slope of the logarithm of light over that of distance, by least squares, each angle for
/// itself. Never below 0.
double fall_off_of(const MeshLight& mesh, std::span<const AngleGroup> lit) {
    double square = 0;
    double product = 0;
    for (const AngleGroup& group : lit) {
        if (group.size() < enough) continue;
        std::vector<double> light;
        std::vector<double> distance;
        for (const Observed* pixel : group) {
            if (!(pixel->distance > 0)) continue;
            light.push_back(std::log(mesh.above_shadow(pixel->value)));
            distance.push_back(std::log(pixel->distance));
        }
        if (light.empty()) continue;
        const double typical_light = median(light);
        const double typical_distance = median(distance);
        for (std::size_t i = 0; i < light.size(); ++i) {
            const double away = distance[i] - typical_distance;
            square += away * away;
            product += away * (light[i] - typical_light);
        }
    }
    const double slope = square > 0 ? -product / square : 0;
    return std::isfinite(slope) ? std::max(slope, 0.0) : 0;
}

std::optional<Typical> shadow_of(std::span<const AngleGroup> groups,
                                 const std::vector<glm::dvec3>& averted, double step) {
    if (averted.size() >= enough) return typical(averted);
    if (const auto shadow = true_shadow(groups, step)) return shadow;
    std::vector<glm::dvec3> dark;
    for (const AngleGroup& group : groups)
        for (const glm::dvec3& value : darker_group(group, step)) dark.push_back(value);
    return typical(dark);
}

} // namespace

double MeshLight::above_shadow(const glm::dvec3& value) const {
    const double apart = glm::distance(value, shadow->color);
    return brightness(value) < brightness(shadow->color) ? -apart : apart;
}

double MeshLight::least_difference(double step) const {
    return fewest_steps * step + 4 * shadow->scatter;
}

std::optional<double> MeshLight::light_at(const Observed& pixel) const {
    if (!shadow || light.empty() || std::isnan(pixel.sine)) return std::nullopt;
    LightAt below;
    double added = light.back().added;
    for (const LightAt& above : light) {
        if (pixel.sine < above.sine) {
            added = glm::mix(below.added, above.added,
                             (pixel.sine - below.sine) / (above.sine - below.sine));
            break;
        }
        below = above;
    }
    added *= std::pow(pixel.distance, -fall_off);
    if (!(added > least_difference(pixel.step))) return std::nullopt;
    return added;
}

MeshLight fitted_light(std::span<const Observed* const> pixels, bool are_differences) {
    std::vector<glm::dvec3> averted;
    AngleGroups groups;
    std::vector<float> steps;
    for (const Observed* const pixel : pixels) {
        if (!std::isfinite(brightness(pixel->value)) ||
            (pixel->faces_light && !std::isfinite(pixel->sine)))
            continue;
        steps.push_back(pixel->step);
        if (pixel->faces_light)
            groups[static_cast<std::size_t>(angle_group(pixel->sine))].push_back(pixel);
        else
            averted.push_back(pixel->value);
    }
    MeshLight mesh;
    if (steps.empty()) return mesh;
    if (are_differences)
        mesh.shadow = Typical{};
    else
        mesh.shadow = shadow_of(groups, averted, median(std::move(steps)));
    if (!mesh.shadow) return mesh;
    for (AngleGroup& group : groups) // what is lit
        std::erase_if(group, [&](const Observed* pixel) {
            return mesh.above_shadow(pixel->value) <= mesh.least_difference(pixel->step);
        });
    mesh.fall_off = fall_off_of(mesh, groups);
    for (const AngleGroup& group : groups) {
        std::vector<double> added;
        std::vector<float> sines;
        for (const Observed* pixel : group) {
            added.push_back(mesh.above_shadow(pixel->value) *
                            std::pow(pixel->distance, mesh.fall_off));
            sines.push_back(pixel->sine);
        }
        if (!added.empty())
            mesh.light.push_back({median(std::move(sines)), median(std::move(added))});
    }
    return mesh;
}

} // namespace shadowproof
