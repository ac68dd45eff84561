// What techniques that filter bump maps have in common: all but the filter, and how it is told.
#pragma once

#include "raster/technique.h"
#include "raster/volumes/stencil.h"

#include <string_view>

namespace shadowproof {

template <BumpFilter filter>
LightingRecipe filtered_lighting(const Plan& plan) {
    constexpr ColorModel model{.filter = filter};
    LightingRecipe made{.steps = add_lit_to_ambient(shader_file("bump_filtered.frag"),
                                                    shader_file("ambient_filtered.frag")),
                        .model = with_settings(model, plan.asked.lighting)};
    return made;
}

/// `cost`: Technique::cost, on distant_bumps alone.
template <BumpFilter filter>
Technique filtered_technique(std::string_view name, std::string_view summary,
                             std::string_view source, double cost) {
    return {
        .name = name,
        .summary = summary,
        .source = source,
        .needs = "bump maps, and blending into an RGBA32F colour buffer; unless named, a file "
                 "that asks for their mipmaps",
        .cost = cost,
        .fails_at = {Cause::precision, Cause::counter, Cause::open_mesh, Cause::alpha,
                     Cause::shading},
        .by_nature = {Cause::shading},
        .needs_bump_maps = true,
        .filters_bumps = true,
        .depth_model = reversed_depths,
        .sees_in_parallel = true,
        .settings = {"normalise", "cube-size", "newton-steps", "vectors", "tangents", "anisotropy"},
        .recipe = zfail_reversed_recipe,
        .lighting = filtered_lighting<filter>};
}

} // namespace shadowproof
