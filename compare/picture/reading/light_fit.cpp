#include "compare/picture/reading/light_fit.h"

#include "compare/picture/reading/typical_colors.h"
#include "compare/picture/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace shadowproof {

namespace {

/// Light falls off with the square of distance, and a picture's curve may show that more steeply.
constexpr double most_fall_off = 4;

/// One of twenty pixels may be otherwise than its surface.
constexpr double unusual = 0.05;

/// What less of the light shows would only make noise larger.
constexpr double least_share_in_cone = 0.25;

/// The sine that a share of the pixels do not reach.
double sine_at(const AngleGroup& pixels, std::size_t normals, double share) {
    std::vector<float> sines;
    for (const Observed* pixel : pixels) sines.push_back(pixel->lies[normals].sine);
    return quantile(std::move(sines), share);
}

/// The darker of two groups of pixels, but where the light only falls on it at a lower angle.
std::vector<glm::dvec3> darker_group(const AngleGroup& group, double step) {
    const std::optional<TwoGroups> two = two_groups(group, step);
    if (!two || sine_at(two->dark, 0, 0.5) < sine_at(two->bright, 0, 0.25)) return {};
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
        if (dark.size() < enough_pixels || bright.size() < enough_pixels) continue;
        const Typical shadow = *typical(dark);
        const glm::dvec3 lit = typical(bright)->color;
        if (brightness(lit) > brightness(shadow.color) &&
            glm::distance(lit, shadow.color) > fewest_steps * step + 4 * shadow.scatter)
            all.insert(all.end(), dark.begin(), dark.end());
    }
    return typical(all);
}

std::optional<Typical> shadow_of(std::span<const AngleGroup> groups,
                                 const std::vector<glm::dvec3>& averted, double step) {
    if (averted.size() >= enough_pixels) return typical(averted);
    if (const auto shadow = true_shadow(groups, step)) return shadow;
    std::vector<glm::dvec3> dark;
    for (const AngleGroup& group : groups)
        for (const glm::dvec3& value : darker_group(group, step)) dark.push_back(value);
    return typical(dark);
}

/// The pixels of a mesh that are of use.
struct Useful {
    std::vector<const Observed*> facing;
    std::vector<glm::dvec3> averted;
    double step = 0;          ///< typical
    bool are_blended = false; ///< those at outlines may show others, too
};

/// Pixels at about one angle that tell what light adds.
struct LitAtAngle {
    AngleGroup lit;
    std::size_t truly_lit = 0;   ///< pixels that are certainly so
    std::size_t shown_lit = 0;   ///< those of them that show light
    std::size_t false_light = 0; ///< pixels certainly in shadow that show light
    double sine = 0;             ///< typical of them
    bool is_dark = false;        ///< there is no light at this angle
    bool is_blended = false;     ///< perhaps: all pixels lie at outlines, where others may show
};

/// What is certainly lit, where that is enough; else what is clearly brighter than shadow. Of two
/// groups of these the brighter. What differs in nothing from the picture without light is no lit
/// one; but what is dim for being lit little, rather than for a shadow, is seen to be no shadow,
/// and textures are as dark as they are.
LitAtAngle lit_ones(const MeshLight& mesh, const AngleGroup& all, const Useful& useful,
                    bool are_differences) {
    LitAtAngle angle;
    AngleGroup truly_lit;
    AngleGroup certain;
    AngleGroup brighter;
    for (const Observed* const pixel : all) {
        if (mesh.share_in_cone(*pixel) < least_share_in_cone) continue;
        const double above = mesh.above_shadow(pixel->value);
        const double least_told = mesh.least_difference(pixel->step);
        if (above > least_told) brighter.push_back(pixel);
        if (pixel->certainly == Visibility::shadowed && above > least_told) ++angle.false_light;
        if (pixel->certainly != Visibility::lit) continue;
        truly_lit.push_back(pixel);
        if (!are_differences || above > least_told / fewest_steps) certain.push_back(pixel);
    }
    angle.truly_lit = truly_lit.size();
    angle.shown_lit = certain.size();
    if (!truly_lit.empty()) angle.sine = sine_at(truly_lit, mesh.normals, 0.5);
    angle.is_blended = useful.are_blended && truly_lit.size() < enough_pixels;
    const AngleGroup& lit = certain.size() < enough_pixels ? brighter : certain;
    const std::optional<TwoGroups> two = two_groups(lit, useful.step);
    angle.lit = two ? two->bright : lit;
    return angle;
}

/// Where most of what is truly lit shows no light, as black surfaces that only have highlights, an
/// angle at which nearly nothing does tells that there is none; unless shadows show some.
void leave_out_dark(std::span<LitAtAngle> angles) {
    std::size_t truly_lit = 0;
    std::size_t shown_lit = 0;
    for (const LitAtAngle& angle : angles) {
        truly_lit += angle.truly_lit;
        shown_lit += angle.shown_lit;
    }
    if (2 * shown_lit >= truly_lit) return;
    for (LitAtAngle& angle : angles)
        if (angle.truly_lit >= enough_pixels && angle.false_light < enough_pixels &&
            static_cast<double>(angle.shown_lit) < unusual * static_cast<double>(angle.truly_lit))
            angle.is_dark = true;
}

/// With which power of the distance light gets weaker, by least squares of logarithms: at about one
/// angle, light depends on what is left of the angle and on distance. From 0 to most_fall_off.
double fall_off_of(const MeshLight& mesh, std::span<const LitAtAngle> angles) {
    // The logarithms' sums of products: sine (s), distance (d), light (l).
    double ss = 0;
    double sd = 0;
    double dd = 0;
    double sl = 0;
    double dl = 0;
    for (const LitAtAngle& angle : angles) {
        if (angle.lit.size() < enough_pixels) continue;
        std::vector<double> light;
        std::vector<double> sine;
        std::vector<double> distance;
        for (const Observed* const pixel : angle.lit) {
            const double above = mesh.above_shadow(pixel->value);
            if (!(pixel->distance > 0) || !(above > 0)) continue;
            light.push_back(std::log(above / mesh.share_in_cone(*pixel)));
            sine.push_back(std::log(pixel->lies[mesh.normals].sine));
            distance.push_back(std::log(pixel->distance));
        }
        if (light.empty()) continue;
        const double typical_light = median(light);
        const double typical_sine = median(sine);
        const double typical_distance = median(distance);
        for (std::size_t i = 0; i < light.size(); ++i) {
            const double s = sine[i] - typical_sine;
            const double d = distance[i] - typical_distance;
            ss += s * s;
            sd += s * d;
            dd += d * d;
            sl += s * (light[i] - typical_light);
            dl += d * (light[i] - typical_light);
        }
    }
    const double slope = (ss * dl - sd * sl) / (ss * dd - sd * sd);
    return std::isfinite(slope) ? std::clamp(-slope, 0.0, most_fall_off) : 0;
}

/// No least light where pixels may be blended with others at outlines.
LightAt fitted_at(const MeshLight& mesh, const AngleGroup& lit, bool is_blended) {
    std::vector<double> added;
    std::vector<double> per_sine;
    for (const Observed* const pixel : lit) {
        added.push_back(mesh.above_shadow(pixel->value) / mesh.share_at(*pixel));
        per_sine.push_back(added.back() / pixel->lies[mesh.normals].sine);
    }
    LightAt at;
    at.sine = sine_at(lit, mesh.normals, 0.5);
    at.typical = median(std::move(added));
    if (!(at.typical > 0) || is_blended) return at;
    // Of a normal distribution of logarithms, one of twenty lies beyond 1.6 deviations, and one of
    // two thousand beyond twice that.
    const double usual = at.sine * quantile(std::move(per_sine), unusual) / at.typical;
    at.least = at.typical * std::clamp(usual, 0.0, 1.0) * std::clamp(usual, 0.0, 1.0);
    return at;
}

/// The same by how far pixels are from a highlight's middle, where enough are.
void fit_highlight(const LitAtAngle& angle, MeshLight& mesh) {
    std::array<AngleGroup, highlight_groups> parts;
    for (const Observed* const pixel : angle.lit)
        parts[highlight_group(pixel->lies[mesh.normals])].push_back(pixel);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].size() >= enough_pixels)
            mesh.in_highlight[i].push_back(fitted_at(mesh, parts[i], angle.is_blended));
}

/// Whether a pixel's surface faces away from the light, whichever normals are taken.
bool is_averted(const Observed& pixel) {
    return !pixel.faces_light && std::all_of(pixel.lies.begin(), pixel.lies.end(),
                                             [](const Lie& lie) { return lie.sine > 0; });
}

/// Whether what is truly dark differs from shadow, and is not as bright as light either: a texture,
/// or ambient light that is not the same on all sides. By how much shadows scatter does not count,
/// which is what patterns do.
bool is_patterned(const MeshLight& mesh, std::span<const Observed* const> pixels) {
    std::size_t dark = 0;
    std::size_t others = 0;
    for (const Observed* const pixel : pixels) {
        if (!is_averted(*pixel) && pixel->certainly != Visibility::shadowed) continue;
        ++dark;
        const double above = mesh.above_shadow(pixel->value);
        const double lit = pixel->faces_light ? mesh.light_at(*pixel).typical : 0;
        const bool is_lit = lit > 0 && above >= 0.5 * lit;
        others += std::abs(above) > fewest_steps * pixel->step && !is_lit ? 1U : 0U;
    }
    return static_cast<double>(others) > unusual * static_cast<double>(dark);
}

/// By how much pixels that are lit, in truth and in the picture, typically differ from what light
/// is said to add. False shadows fit no normals, and say nothing about them.
double misfit(const MeshLight& mesh, std::span<const Observed* const> facing) {
    if (mesh.light.empty()) return std::numeric_limits<double>::infinity();
    std::vector<double> errors;
    for (const Observed* const pixel : facing) {
        if (pixel->certainly != Visibility::lit) continue;
        const double above = mesh.above_shadow(pixel->value);
        if (above > mesh.least_difference(pixel->step))
            errors.push_back(std::abs(above - mesh.light_at(*pixel).typical));
    }
    return errors.empty() ? 0 : median(std::move(errors));
}

void fit_light(std::span<const LitAtAngle> angles, MeshLight& mesh) {
    for (const LitAtAngle& angle : angles)
        if (angle.is_dark) {
            mesh.light.push_back({angle.sine, 0, 0});
        } else if (!angle.lit.empty()) {
            mesh.light.push_back(fitted_at(mesh, angle.lit, angle.is_blended));
            fit_highlight(angle, mesh);
        }
}

Useful useful_of(std::span<const Observed* const> pixels) {
    Useful useful;
    std::vector<float> steps;
    for (const Observed* const pixel : pixels) {
        if (!std::isfinite(brightness(pixel->value))) continue;
        if (!pixel->faces_light)
            useful.averted.push_back(pixel->value);
        else if (std::isfinite(pixel->lies[0].sine))
            useful.facing.push_back(pixel);
        else
            continue;
        steps.push_back(pixel->step);
    }
    if (!steps.empty()) useful.step = median(std::move(steps));
    return useful;
}

AngleGroups by_angle(const Useful& useful, std::size_t normals) {
    AngleGroups groups;
    for (const Observed* const pixel : useful.facing)
        if (const float sine = pixel->lies[normals].sine; sine > 0)
            groups[static_cast<std::size_t>(angle_group(sine))].push_back(pixel);
    return groups;
}

MeshLight fitted_by(std::size_t normals, const Useful& useful, const Typical& shadow, Shown shown,
                    std::vector<ConeShare> cone) {
    MeshLight mesh;
    mesh.shadow = shadow;
    mesh.normals = normals;
    mesh.cone = std::move(cone);
    const AngleGroups groups = by_angle(useful, normals);
    std::array<LitAtAngle, angle_groups> angles;
    std::transform(groups.begin(), groups.end(), angles.begin(), [&](const AngleGroup& group) {
        return lit_ones(mesh, group, useful, shown == Shown::differences);
    });
    leave_out_dark(angles);
    MeshLight falling = mesh;
    falling.fall_off = fall_off_of(mesh, angles);
    fit_light(angles, mesh);
    if (falling.fall_off > 0) {
        fit_light(angles, falling);
        if (2 * misfit(falling, useful.facing) < misfit(mesh, useful.facing))
            mesh = std::move(falling);
    }
    return mesh;
}

/// Pixels between a spot's cones that are certainly lit.
std::vector<const Observed*> between_cones(const Useful& useful) {
    std::vector<const Observed*> between;
    for (const Observed* const pixel : useful.facing)
        if (is_between_cones(*pixel) && pixel->certainly == Visibility::lit)
            between.push_back(pixel);
    return between;
}

/// By how much pixels between a spot's cones typically differ from what light is said to add, over
/// that; infinity where too few are said to have any.
double misfit_in_cone(const MeshLight& mesh, std::span<const Observed* const> between) {
    std::vector<double> errors;
    for (const Observed* const pixel : between) {
        const double said = mesh.light_at(*pixel).typical;
        if (!(said > mesh.least_difference(pixel->step))) continue;
        errors.push_back(std::abs(mesh.above_shadow(pixel->value) / said - 1));
    }
    return errors.size() < enough_pixels ? std::numeric_limits<double>::infinity()
                                         : median(std::move(errors));
}

/// Which shares of the light pixels show so far into a spot's cone, over what they would show with
/// all of it; the largest is 1.
std::vector<ConeShare> cone_of(const MeshLight& mesh, const Useful& useful) {
    std::array<std::vector<double>, cone_parts + 1> shares; // the last: within the inner cone
    std::array<std::vector<double>, cone_parts + 1> into_cone;
    for (const Observed* const pixel : useful.facing) {
        const double all = mesh.light_at(*pixel).typical / mesh.share_in_cone(*pixel);
        if (pixel->certainly != Visibility::lit || !(all > 0) || !std::isfinite(all)) continue;
        const std::size_t part = cone_part(*pixel);
        shares[part].push_back(std::max(mesh.above_shadow(pixel->value) / all, 0.0));
        into_cone[part].push_back(pixel->into_cone);
    }
    std::vector<ConeShare> cone;
    double largest = 0;
    for (std::size_t part = 0; part <= cone_parts; ++part) {
        if (shares[part].size() < enough_pixels) continue;
        cone.push_back({median(std::move(into_cone[part])), median(std::move(shares[part]))});
        largest = std::max(largest, cone.back().share);
    }
    if (!(largest > 0)) return {};
    for (ConeShare& each : cone) each.share /= largest;
    return cone;
}

/// Where pixels lie between a spot's cones, how light falls off there is fitted in turn with how it
/// depends on angles, which the other divides out. In a part of the way where that does not say
/// within a quarter how bright most are, it is not known.
MeshLight fitted_by(std::size_t normals, const Useful& useful, const Typical& shadow, Shown shown) {
    MeshLight best = fitted_by(normals, useful, shadow, shown, {});
    if (std::ranges::all_of(useful.facing,
                            [](const Observed* pixel) { return !is_between_cones(*pixel); }))
        return best;
    const std::vector<const Observed*> between = between_cones(useful);
    double least = misfit_in_cone(best, between);
    constexpr int rounds = 6;
    MeshLight mesh = best;
    for (int round = 0; round < rounds; ++round) {
        std::vector<ConeShare> cone = cone_of(mesh, useful);
        if (cone.empty()) break;
        mesh = fitted_by(normals, useful, shadow, shown, std::move(cone));
        const double misfit = misfit_in_cone(mesh, between);
        if (!(misfit < least)) continue;
        least = misfit;
        best = mesh;
    }
    std::array<AngleGroup, cone_parts> parts;
    for (const Observed* const pixel : between) parts[cone_part(*pixel)].push_back(pixel);
    for (std::size_t part = 0; part < cone_parts; ++part)
        best.is_cone_unknown[part] = !(misfit_in_cone(best, parts[part]) < 0.25);
    return best;
}

/// Whether normals lie to the light as some before them do, at all pixels.
bool lie_as_others(std::span<const Observed* const> pixels, std::size_t normals) {
    for (std::size_t others = 0; others < normals; ++others)
        if (std::all_of(pixels.begin(), pixels.end(), [&](const Observed* pixel) {
                return pixel->lies[normals].sine == pixel->lies[others].sine;
            }))
            return true;
    return false;
}

/// Whether the picture shows light where these normals say that there is none: on nearly all pixels
/// that are truly lit and turned away by them. One step of the file is rounding.
bool shows_light_on_averted(const MeshLight& mesh, std::span<const Observed* const> facing) {
    std::size_t averted = 0;
    std::size_t dark = 0;
    for (const Observed* const pixel : facing) {
        const double least_told = mesh.least_difference(pixel->step);
        const double said = mesh.light_at(*pixel).typical;
        if (pixel->certainly != Visibility::lit || said > least_told) continue;
        ++averted;
        const double above = mesh.above_shadow(pixel->value);
        dark += above > std::max(least_told, said + pixel->step) ? 0U : 1U;
    }
    return averted >= enough_pixels &&
           static_cast<double>(dark) < unusual * static_cast<double>(averted);
}

} // namespace

std::vector<MeshLight> fitted_light(std::span<const Observed* const> pixels, Shown shown,
                                    bool blended) {
    Useful useful = useful_of(pixels);
    useful.are_blended = blended;
    std::optional<Typical> shadow = Typical{};
    if (shown != Shown::differences)
        shadow = shadow_of(by_angle(useful, 0), useful.averted, useful.step);
    if (!shadow) return {MeshLight{}};
    std::vector<MeshLight> fits;
    std::vector<double> misfits;
    for (std::size_t normals = 0; normals < all_normals_by.size(); ++normals) {
        if (lie_as_others(pixels, normals)) continue;
        fits.push_back(fitted_by(normals, useful, *shadow, shown));
        misfits.push_back(misfit(fits.back(), useful.facing));
    }
    const auto best = std::min_element(misfits.begin(), misfits.end()) - misfits.begin();
    std::vector<MeshLight> kept{fits[static_cast<std::size_t>(best)]};
    for (std::size_t i = 0; i < fits.size(); ++i)
        if (static_cast<std::ptrdiff_t>(i) != best &&
            misfits[i] <= 2 * (misfits[static_cast<std::size_t>(best)] + 2 * useful.step) &&
            !shows_light_on_averted(fits[i], useful.facing))
            kept.push_back(std::move(fits[i]));
    if (shown == Shown::textured && is_patterned(kept.front(), pixels)) return {MeshLight{}};
    return kept;
}

} // namespace shadowproof
