#include "compare/maps/map_cause.h"

#include <cmath>
#include <glm/geometric.hpp>

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

PixelCause of_false_shadow(const LightView& light, const Scene& scene, const WrongAnswer& wrong) {
    const MapModel& model = light.model();
    if (!is_in_range(model, wrong.lookup)) return {Cause::range, {}};
    if (!(wrong.shown.moved + model.bias < wrong.lookup.value)) return {Cause::precision, {}};
    return {are_joined(scene, wrong.shown.triangle, wrong.receiver) ? Cause::acne
                                                                    : Cause::resolution,
            {}};
}

PixelCause of_false_light(const LightView& light, const WrongAnswer& wrong) {
    const MapModel& model = light.model();
    const double own = wrong.lookup.value;
    if (wrong.lookup.in_map && wrong.shown.moved + model.bias < own) return {Cause::precision, {}};
    const FromLight met = met_on_the_way(light, wrong.lookup, wrong.from_light);
    if (met.triangle == no_triangle || met.triangle == wrong.receiver)
        return {model.culling != MapCulling::none ? Cause::open_mesh : Cause::range, {}};
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
