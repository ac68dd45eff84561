// Why a pixel differs from the truth: the causes that techniques, scenes and verdicts name.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace shadowproof {

enum class Cause : std::uint8_t {
    edge,         ///< truth changes within the rasterizer's own lateral error; never a defect
    near_plane,   ///< crossings between eye and near plane were lost
    far_plane,    ///< crossings past the far plane were lost
    eye_inside,   ///< the eye is inside a shadow volume that the counter's start value leaves out
    extrusion,    ///< the volume ends before it reaches the surface
    cap,          ///< a crossing was lost through a missing cap
    counter,      ///< the stencil counter overflowed or saturated
    parity,       ///< overlapping volumes of even depth, counted by inverting
    open_mesh,    ///< the caster does not enclose a volume towards the light
    light_inside, ///< a closed caster holds the light, and perhaps none of its triangles faces it
    alpha,        ///< what an alpha mask leaves out of a caster casts a shadow
    resolution,   ///< the texel's ray from the light does not go through the pixel's point
    acne,         ///< the receiver shadows itself: the bias or epsilon is too small
    leak,         ///< an occluder lies within the bias or epsilon, which is too large
    range,        ///< outside what the light's camera draws: its near and far plane, its square
    seam,         ///< what lies beyond a face of a cube map was taken from its border
    filter,       ///< the texels around the point's own were averaged with it
    missed,    ///< a float ray slipped between two triangles, or hit one that the exact ray misses
    precision, ///< disappears when the surface moves by one quantum of the depth format, or
               ///< when a float ray is not rounded
    shading,   ///< colour beyond its derived bound
    unexplained, ///< no prediction matches: always a failure
};

struct CauseWords {
    Cause cause;
    std::string_view name;    ///< as in results and on the command line
    std::string_view meaning; ///< one clause for legends
};

/// All causes in the order of the enumerators.
inline constexpr std::array<CauseWords, 21> all_causes{{
    {Cause::edge, "edge", "within the rasterizer's lateral error"},
    {Cause::near_plane, "near_plane", "crossings were lost before the near plane"},
    {Cause::far_plane, "far_plane", "crossings were lost past the far plane"},
    {Cause::eye_inside, "eye_inside", "the eye is inside a shadow volume, which was not counted"},
    {Cause::extrusion, "extrusion", "the volume ends before it reaches the surface"},
    {Cause::cap, "cap", "a crossing was lost through a missing cap"},
    {Cause::counter, "counter", "the stencil counter overflowed or saturated"},
    {Cause::parity, "parity", "overlapping volumes of even depth"},
    {Cause::open_mesh, "open_mesh", "the caster encloses no volume towards the light"},
    {Cause::light_inside, "light_inside", "the light is inside a closed caster"},
    {Cause::alpha, "alpha", "an alpha mask's holes in a caster were shadowed"},
    {Cause::resolution, "resolution", "the map is too coarse"},
    {Cause::acne, "acne", "the receiver shadows itself: a larger bias or epsilon mends it"},
    {Cause::leak, "leak", "an occluder lies within the bias or epsilon: a smaller one mends it"},
    {Cause::range, "range",
     "outside what the light's camera draws: its near and far plane, its square"},
    {Cause::seam, "seam", "averaged at a cube face's border, without the adjacent face"},
    {Cause::filter, "filter", "averaged with its neighbours: its own texel is right"},
    {Cause::missed, "missed", "a float ray slipped between triangles, or hit one beside it"},
    {Cause::precision, "precision", "within the rounding of depths or rays"},
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

/// In pictures of causes: the pixel does not differ.
inline constexpr std::uint8_t no_difference = 0xff;

/// A set of causes, one bit each.
class CauseSet {
public:
    constexpr bool empty() const { return bits_ == 0; }
    constexpr bool contains(Cause cause) const { return (bits_ & bit(cause)) != 0; }
    constexpr void add(Cause cause) { bits_ |= bit(cause); }
    friend constexpr bool operator==(CauseSet, CauseSet) = default;

    /// The set as pictures store it.
    constexpr std::uint32_t bits() const { return bits_; }
    static constexpr CauseSet of(std::uint32_t bits) {
        CauseSet set;
        set.bits_ = bits;
        return set;
    }

private:
    std::uint32_t bits_ = 0;
    static constexpr std::uint32_t bit(Cause cause) {
        return std::uint32_t{1} << static_cast<unsigned>(cause);
    }
};

} // namespace shadowproof
