#include "compare/picture/reading/mesh_light.h"

#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowproof {

double brightness(const glm::dvec3& color) {
    return color.x + color.y + color.z;
}

std::size_t highlight_group(const Lie& lie) {
    const float group = lie.off_half * highlight_groups;
    // What is no number belongs to no highlight.
    return group < highlight_groups ? static_cast<std::size_t>(group) : highlight_groups - 1;
}

double MeshLight::above_shadow(const glm::dvec3& value) const {
    const double apart = glm::distance(value, shadow->color);
    return brightness(value) < brightness(shadow->color) ? -apart : apart;
}

double MeshLight::least_difference(double step) const {
    return fewest_steps * step + 4 * shadow->scatter;
}

namespace {

/// The known shares on both sides of a pixel; from nothing, and to the last.
std::array<ConeShare, 2> beside(const std::vector<ConeShare>& cone, double into_cone) {
    ConeShare below;
    for (const ConeShare& above : cone) {
        if (into_cone < above.into_cone) return {below, above};
        below = above;
    }
    return {below, below};
}

} // namespace

double MeshLight::share_in_cone(const Observed& pixel) const {
    if (cone.empty() || !is_between_cones(pixel)) return 1;
    const auto [below, above] = beside(cone, pixel.into_cone);
    if (!(below.into_cone < above.into_cone)) return below.share;
    return glm::mix(below.share, above.share,
                    (pixel.into_cone - below.into_cone) / (above.into_cone - below.into_cone));
}

double MeshLight::least_in_cone(const Observed& pixel) const {
    if (cone.empty() || !is_between_cones(pixel)) return 1;
    const auto [below, above] = beside(cone, pixel.into_cone);
    return std::min(below.share, above.share);
}

double MeshLight::share_at(const Observed& pixel) const {
    return std::pow(pixel.distance, -fall_off) * share_in_cone(pixel);
}

namespace {

/// Between the angles that are known, down to nothing where light only grazes; beyond the last as
/// there.
LightAt interpolated(const LightByAngle& known, double sine) {
    LightAt below;
    for (const LightAt& above : known) {
        if (sine < above.sine) {
            const double way = (sine - below.sine) / (above.sine - below.sine);
            return {sine, glm::mix(below.typical, above.typical, way),
                    glm::mix(below.least, above.least, way)};
        }
        below = above;
    }
    return below;
}

} // namespace

LightAt MeshLight::light_at(const Observed& pixel) const {
    const Lie& lie = pixel.lies[normals];
    const LightByAngle& own = in_highlight[highlight_group(lie)];
    const LightByAngle& known = own.empty() ? light : own;
    const double sine = lie.sine;
    if (known.empty() || !(sine > 0)) return {};
    LightAt at = interpolated(known, sine);
    // So near to a highlight's middle, other angles are known: nothing says that light is as even
    // at this one.
    const int group = angle_group(lie.sine);
    if (!own.empty() && (group < angle_group(static_cast<float>(own.front().sine)) ||
                         group > angle_group(static_cast<float>(own.back().sine))))
        at.least = std::min(at.least, interpolated(light, sine).least);
    const double weaker = std::pow(pixel.distance, -fall_off);
    return {sine, at.typical * weaker * share_in_cone(pixel),
            at.least * weaker * least_in_cone(pixel)};
}

ShownLight MeshLight::shown_light(const Observed& pixel) const {
    if (!shadow) return {};
    const LightAt lit = light_at(pixel);
    const double least_told = least_difference(pixel.step);
    if (!(lit.typical > least_told)) return {};
    const double above = above_shadow(pixel.value);
    const double share = above / lit.typical;
    if (share >= 0.5) return {share, true};
    const bool is_known = !is_between_cones(pixel) || !is_cone_unknown[cone_part(pixel)];
    return {share, is_known && lit.least > least_told && above < 0.5 * lit.least};
}

ShownLight shown_light(std::span<const MeshLight> fits, const Observed& pixel) {
    ShownLight shown = fits.front().shown_light(pixel);
    if (shown.share >= 0.5) return shown; // light is seen, whatever others make of it
    for (const MeshLight& fit : fits.subspan(1)) {
        const ShownLight other = fit.shown_light(pixel);
        shown.told &= other.told && other.share < 0.5;
    }
    return shown;
}

} // namespace shadowproof
