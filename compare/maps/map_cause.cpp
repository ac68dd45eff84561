#include "compare/maps/map_cause.h"

#include "reference/trace/places.h"
#include "reference/trace/view.h"

#include <limits>
#include <optional>

namespace shadowproof {

namespace {

bool are_joined(const Scene& scene, std::uint32_t one, std::uint32_t other) {
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (corner(scene, one, i) == corner(scene, other, k)) return true;
    return false;
}

/// Whether what a ray from the light has met stands before a point of the receiver at this depth.
/// What lies in the receiver's plane does not, whatever the roundings of both depths.
bool stands_before(const Scene& scene, const FromLight& met, std::uint32_t receiver, double depth) {
    return met.triangle != no_triangle && met.triangle != receiver && met.depth < depth &&
           !are_coplanar(corners(scene, receiver), corners(scene, met.triangle));
}

bool is_in_range(const MapModel& model, const Lookup& lookup) {
    return lookup.in_map && lookup.depth >= model.near && lookup.depth <= model.far &&
           lookup.value <= model.far;
}

/// A texel's ray that meets something before the point does not go through the point. What it meets
/// is the receiver itself, or another triangle. With a bias below zero, neither that ray nor a bias
/// of zero is enough alone where it is another.
PixelCause of_texel(const Scene& scene, const MapModel& model, std::uint32_t shown,
                    std::uint32_t receiver) {
    if (are_joined(scene, shown, receiver)) return {Cause::acne, {}};
    if (!(model.bias < 0)) return {Cause::resolution, {}};
    PixelCause cause{Cause::acne, {}};
    cause.also.add(Cause::resolution);
    return cause;
}

/// A wrong answer whose cause is still to be named.
struct Open {
    const WrongAnswer& wrong;
    PixelCause& cause;
};

/// What the rays from the light through the points themselves meet first.
std::vector<FromLight> to_points(const LightView& light, std::span<const Open> open,
                                 const LiftedLimits& lifted = {}) {
    std::vector<PointOnFace> points;
    points.reserve(open.size());
    for (const Open& o : open) points.push_back({o.wrong.lookup.texel.face, o.wrong.from_light});
    return light.trace_to(points, lifted);
}

/// What the texels would show without some of the camera's limits.
std::vector<LightView::Shown> at_texels(const LightView& light, std::span<const Open> open,
                                        const LiftedLimits& lifted) {
    std::vector<Texel> texels;
    texels.reserve(open.size());
    for (const Open& o : open) texels.push_back(o.wrong.lookup.texel);
    const std::vector<FromLight> met = light.trace_without(lifted, texels);
    std::vector<LightView::Shown> shown;
    shown.reserve(open.size());
    for (std::size_t i = 0; i < open.size(); ++i)
        shown.push_back(light.showing(texels[i], met[i].triangle));
    return shown;
}

/// Of points that the map does not reach. Where the light's camera sees one, the ray through it
/// finds what the map was cleared to.
void name_beyond_range(const LightView& light, const Scene& scene, std::span<const Open> open) {
    const MapModel& model = light.model();
    const std::vector<LightView::Shown> reached = at_texels(light, open, {.range = true});
    for (std::size_t i = 0; i < open.size(); ++i) {
        const auto& [wrong, cause] = open[i];
        const double own = wrong.lookup.value;
        const double kept = reached[i].value <= model.far ? reached[i].moved : reached[i].value;
        if (!(kept + model.bias < own)) {
            cause = {Cause::range, {}};
            continue;
        }
        cause = of_texel(scene, model, reached[i].triangle, wrong.receiver);
        if (!is_shadowed(model, 1, own)) continue;
        cause.also.add(cause.cause);
        cause.cause = Cause::range;
    }
}

/// The value of the occluder that the ray through a point has met, where that value is compared
/// with the point's; infinity: none stands before it.
double occluding(const Scene& scene, const WrongAnswer& wrong, const FromLight& met) {
    return stands_before(scene, met, wrong.receiver, wrong.lookup.depth)
               ? wrong.lookup.value * met.depth / wrong.lookup.depth
               : std::numeric_limits<double>::infinity();
}

/// Of light that no caster takes away on the ray through the point itself, as the light's camera is
/// limited: which of its limits must go so that one does, the fewest that suffice.
void name_missing_occluders(const LightView& light, const Scene& scene,
                            std::span<const Open> open) {
    const MapModel& model = light.model();
    const bool culls = model.culling != MapCulling::none;
    struct Lifted {
        std::vector<FromLight> to_point;
        std::vector<LightView::Shown> at_texel;
    };
    const auto without = [&](const LiftedLimits& lifted) {
        return Lifted{to_points(light, open, lifted), at_texels(light, open, lifted)};
    };
    const Lifted in_range = without({.range = true});
    const Lifted unculled = culls ? without({.culling = true}) : Lifted{};
    const Lifted unlimited = culls ? without({.range = true, .culling = true}) : Lifted{};
    for (std::size_t i = 0; i < open.size(); ++i) {
        const auto& [wrong, cause] = open[i];
        const double own = wrong.lookup.value;
        // The texel's own ray may miss what the ray through the point meets.
        const auto named = [&](Cause why, const Lifted& lifted) {
            PixelCause found{why, {}};
            if (wrong.lookup.in_map && !(lifted.at_texel[i].value + model.bias < own))
                found.also.add(Cause::resolution);
            return found;
        };
        const auto occludes = [&](const Lifted& lifted, double bias) {
            return occluding(scene, wrong, lifted.to_point[i]) + bias < own;
        };
        if (culls && occludes(unculled, model.bias)) {
            cause = named(Cause::open_mesh, unculled);
        } else if (!culls || !wrong.lookup.in_map || occludes(in_range, model.bias)) {
            cause = named(Cause::range, in_range);
        } else {
            cause = named(Cause::open_mesh, unlimited);
            if (!occludes(unculled, 0)) cause.also.add(Cause::range);
        }
    }
}

/// Of light where what the texel holds does not say so.
void name_false_light(const LightView& light, const Scene& scene, std::span<const Open> open) {
    const MapModel& model = light.model();
    std::vector<FromLight> met = to_points(light, open);
    std::vector<Open> missing;
    for (std::size_t i = 0; i < open.size(); ++i) {
        const auto& [wrong, cause] = open[i];
        const double own = wrong.lookup.value;
        const double occluder = wrong.lookup.in_map ? occluding(scene, wrong, met[i])
                                                    : std::numeric_limits<double>::infinity();
        if (occluder == std::numeric_limits<double>::infinity()) {
            missing.push_back(open[i]);
            continue;
        }
        const double value = light.moved_away(wrong.lookup.texel, met[i].triangle, occluder);
        if (value + model.bias < own) {
            cause = {Cause::resolution, {}};
            continue;
        }
        cause = {Cause::leak, {}};
        if (!(wrong.shown.value < own)) cause.also.add(Cause::resolution);
    }
    name_missing_occluders(light, scene, missing);
}

/// Whether a block that continues on the adjacent face of a cube would answer rightly.
bool seamless_is_right(const LightView& light, const WrongAnswer& wrong) {
    MapModel model = light.model();
    if (model.edges == MapEdges::seamless || !crosses_edge(model, wrong.lookup)) return false;
    model.edges = MapEdges::seamless;
    return lit_comparisons(light, model, wrong.lookup) == (wrong.claims_light ? 0 : model.asked());
}

/// The cause, where it is that a block is averaged.
std::optional<Cause> of_block(const LightView& light, const WrongAnswer& wrong) {
    const MapModel& model = light.model();
    if (model.filter == 0) return std::nullopt;
    if (seamless_is_right(light, wrong)) return Cause::seam;
    const bool own_says_lit =
        !wrong.lookup.in_map ||
        !is_shadowed(model, light.stored(wrong.lookup.texel), wrong.lookup.value);
    if (own_says_lit != wrong.claims_light) return Cause::filter;
    return std::nullopt;
}

} // namespace

bool light_reaches(const LightView& light, const Scene& scene, const Lookup& lookup,
                   const glm::dvec3& from_light, std::uint32_t receiver) {
    if (!lookup.in_map) return true;
    const PointOnFace point{lookup.texel.face, from_light};
    const FromLight met = light.trace_to(std::span(&point, 1)).front();
    return !stands_before(scene, met, receiver, lookup.depth);
}

std::vector<PixelCause> causes_of(const LightView& light, const Scene& scene,
                                  std::span<const WrongAnswer> answers) {
    const MapModel& model = light.model();
    std::vector<PixelCause> causes(answers.size());
    std::vector<Open> falsely_lit;
    std::vector<Open> beyond_range;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const WrongAnswer& wrong = answers[i];
        const bool texel_says_shadowed = wrong.shown.moved + model.bias < wrong.lookup.value;
        if (const std::optional<Cause> cause = of_block(light, wrong))
            causes[i] = {*cause, {}};
        else if (wrong.claims_light && wrong.lookup.in_map && texel_says_shadowed)
            causes[i] = {Cause::precision, {}};
        else if (wrong.claims_light)
            falsely_lit.push_back({wrong, causes[i]});
        else if (!is_in_range(model, wrong.lookup))
            beyond_range.push_back({wrong, causes[i]});
        else if (!texel_says_shadowed)
            causes[i] = {Cause::precision, {}};
        else
            causes[i] = of_texel(scene, model, wrong.shown.triangle, wrong.receiver);
    }
    name_false_light(light, scene, falsely_lit);
    name_beyond_range(light, scene, beyond_range);
    return causes;
}

} // namespace shadowproof
