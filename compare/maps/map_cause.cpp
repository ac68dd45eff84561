#include "compare/maps/map_cause.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowproof {

namespace {

bool are_joined(const Scene& scene, std::uint32_t one, std::uint32_t other) {
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (corner(scene, one, i) == corner(scene, other, k)) return true;
    return false;
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

/// Of a point that the map does not reach. Where the light's camera sees it, the ray through it
/// finds what the map was cleared to.
PixelCause beyond_range(const LightView& light, const Scene& scene, const WrongAnswer& wrong) {
    const MapModel& model = light.model();
    const double own = wrong.lookup.value;
    const LightView::Shown whole = light.shown_without({.range = true}, wrong.lookup.texel);
    const double kept = whole.value <= model.far ? whole.moved : whole.value;
    if (!(kept + model.bias < own)) return {Cause::range, {}};
    PixelCause cause = of_texel(scene, model, whole.triangle, wrong.receiver);
    if (!is_shadowed(model, 1, own)) return cause;
    cause.also.add(cause.cause);
    cause.cause = Cause::range;
    return cause;
}

PixelCause of_false_shadow(const LightView& light, const Scene& scene, const WrongAnswer& wrong) {
    const MapModel& model = light.model();
    if (!is_in_range(model, wrong.lookup)) return beyond_range(light, scene, wrong);
    if (!(wrong.shown.moved + model.bias < wrong.lookup.value)) return {Cause::precision, {}};
    return of_texel(scene, model, wrong.shown.triangle, wrong.receiver);
}

/// The cause of light that no caster takes away on the ray through the point itself, as the light's
/// camera is limited: which of its limits must go so that one does, the fewest that suffice.
PixelCause of_missing_occluder(const LightView& light, const WrongAnswer& wrong) {
    const MapModel& model = light.model();
    const double own = wrong.lookup.value;
    const auto found = [&](const LiftedLimits& lifted) {
        const FromLight met =
            light.trace_without(lifted, wrong.lookup.texel.face, wrong.from_light);
        return met.triangle != no_triangle && met.triangle != wrong.receiver &&
                       met.depth < wrong.lookup.depth
                   ? own * met.depth / wrong.lookup.depth
                   : std::numeric_limits<double>::infinity();
    };
    // The texel's own ray may miss what the ray through the point meets.
    const auto named = [&](Cause cause, const LiftedLimits& lifted) {
        PixelCause why{cause, {}};
        if (wrong.lookup.in_map &&
            !(light.shown_without(lifted, wrong.lookup.texel).value + model.bias < own))
            why.also.add(Cause::resolution);
        return why;
    };
    const bool culls = model.culling != MapCulling::none;
    const double in_range = found({.range = true});
    const double unculled = culls ? found({.culling = true}) : in_range;
    if (culls && unculled + model.bias < own) return named(Cause::open_mesh, {.culling = true});
    if (in_range + model.bias < own || !culls || !wrong.lookup.in_map)
        return named(Cause::range, {.range = true});
    PixelCause cause = named(Cause::open_mesh, {.range = true, .culling = true});
    if (!(unculled < own)) cause.also.add(Cause::range);
    return cause;
}

PixelCause of_false_light(const LightView& light, const WrongAnswer& wrong) {
    const MapModel& model = light.model();
    const double own = wrong.lookup.value;
    if (wrong.lookup.in_map && wrong.shown.moved + model.bias < own) return {Cause::precision, {}};
    const FromLight met = met_on_the_way(light, wrong.lookup, wrong.from_light);
    const bool is_occluder = met.triangle != no_triangle && met.triangle != wrong.receiver &&
                             met.depth < wrong.lookup.depth;
    if (!is_occluder) return of_missing_occluder(light, wrong);
    const double met_value =
        light.moved_away(wrong.lookup.texel, met.triangle, own * met.depth / wrong.lookup.depth);
    if (met_value + model.bias < own) return {Cause::resolution, {}};
    PixelCause cause{Cause::leak, {}};
    if (!(wrong.shown.value < own)) cause.also.add(Cause::resolution);
    return cause;
}

/// Whether a block that continues on the adjacent face of a cube would answer rightly.
bool seamless_is_right(const LightView& light, const WrongAnswer& wrong) {
    MapModel model = light.model();
    if (model.edges == MapEdges::seamless || !crosses_edge(model, wrong.lookup)) return false;
    model.edges = MapEdges::seamless;
    return lit_comparisons(light, model, wrong.lookup) == (wrong.claims_light ? 0 : model.asked());
}

} // namespace

FromLight met_on_the_way(const LightView& light, const Lookup& lookup,
                         const glm::dvec3& from_light) {
    return lookup.in_map ? light.trace_to(lookup.texel.face, from_light)
                         : FromLight{no_triangle, 0};
}

bool light_reaches(const LightView& light, const Lookup& lookup, const glm::dvec3& from_light,
                   std::uint32_t receiver) {
    const FromLight met = met_on_the_way(light, lookup, from_light);
    return met.triangle == no_triangle || met.triangle == receiver || met.depth >= lookup.depth;
}

PixelCause cause_of(const LightView& light, const Scene& scene, const WrongAnswer& wrong) {
    const MapModel& model = light.model();
    if (model.filter > 0) {
        if (seamless_is_right(light, wrong)) return {Cause::seam, {}};
        const bool own_says_lit =
            !wrong.lookup.in_map ||
            !is_shadowed(model, light.stored(wrong.lookup.texel), wrong.lookup.value);
        if (own_says_lit != wrong.claims_light) return {Cause::filter, {}};
    }
    return wrong.claims_light ? of_false_light(light, wrong) : of_false_shadow(light, scene, wrong);
}

} // namespace shadowproof
