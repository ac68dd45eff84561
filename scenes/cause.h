// Why a pixel differs from the truth: the words that techniques, scenes and verdicts share.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace shadowproof {

enum class Cause : std::uint8_t {
    edge,        ///< truth changes within the rasterizer's own lateral freedom; never a defect
    near_plane,  ///< the near plane lies inside a shadow volume
    far_plane,   ///< a shadow volume is cut by the far plane
    eye_inside,  ///< the eye itself is inside a shadow volume
    extrusion,   ///< the volume ends before it reaches the surface
    cap,         ///< a crossing was lost through a missing cap
    counter,     ///< the stencil counter overflowed or saturated
    parity,      ///< overlapping volumes of even depth, counted by inverting
    open_mesh,   ///< the caster does not enclose a volume towards the light
    resolution,  ///< another point of the shadow map texel's footprint has another answer
    acne,        ///< the shadow map texel saw the receiver itself
    leak,        ///< a true occluder lies within the bias
    precision,   ///< gone when the surface moves by the quantum of the depth format, or
                 ///< the light off the caster it lies on, as far as floats tell
    shading,     ///< colour beyond its derived bound
    unexplained, ///< no prediction matches: always a failure
};

struct CauseWords {
    Cause cause;
    std::string_view name;    ///< as in results and on the command line
    std::string_view meaning; ///< one clause for legends
};

/// All causes in the order of the enumerators.
inline constexpr std::array<CauseWords, 15> all_causes{{
    {Cause::edge, "edge", "within the rasterizer's lateral freedom"},
    {Cause::near_plane, "near_plane", "the near plane lies inside a shadow volume"},
    {Cause::far_plane, "far_plane", "the far plane cuts a shadow volume"},
    {Cause::eye_inside, "eye_inside", "the eye is inside a shadow volume"},
    {Cause::extrusion, "extrusion", "the volume ends before it reaches the surface"},
    {Cause::cap, "cap", "a crossing was lost through a missing cap"},
    {Cause::counter, "counter", "the stencil counter overflowed or saturated"},
    {Cause::parity, "parity", "overlapping volumes of even depth"},
    {Cause::open_mesh, "open_mesh", "the caster encloses no volume towards the light"},
    {Cause::resolution, "resolution", "the shadow map texel covers both answers"},
    {Cause::acne, "acne", "the shadow map texel saw the receiver itself"},
    {Cause::leak, "leak", "an occluder lies within the bias"},
    {Cause::precision, "precision", "within the rounding of depths, or of a light on a caster"},
    {Cause::shading, "shading", "the colour is beyond its bound"},
    {Cause::unexplained, "unexplained", "no prediction matches"},
}};

constexpr std::string_view name_of(Cause cause) {
    return all_causes[static_cast<std::size_t>(cause)].name;
}

constexpr std::optional<Cause> cause_named(std::string_view name) {
    for (const CauseWords& words : all_causes)
        if (words.name == name) return words.cause;
    return std::nullopt;
}

} // namespace shadowproof
