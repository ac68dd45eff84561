// The limitations of stencil techniques, and the counting model of the same technique without some
// of them. This is the first half of a counterfactual; compare/stencil/counterfactual.h has the
// second.
#pragma once

#include "scenes/cause.h"
#include "scenes/frame.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace shadowproof {

/// In the order in which causes are listed, but that alpha comes before what changes how many of a
/// closed caster's triangles are counted: a mask's hole is seldom the parity of something else.
enum class Limitation : std::uint8_t {
    near_clip,    ///< faces in front of the near plane are lost
    far_clip,     ///< faces past the far plane are lost, and with them dark caps at infinity
    eye_start,    ///< the counter begins at zero, however many volumes contain the eye
    extrusion,    ///< volumes end at a finite distance
    caps,         ///< light caps or dark caps are not drawn
    counter,      ///< the counter has limited bits, or stops at its limits
    alpha,        ///< what alpha masks leave out of casters casts a shadow
    parity,       ///< only the parity of the count is kept
    open_mesh,    ///< casters' triangles that face away from the light cast no shadow by
                  ///< themselves, or triangles that fill holes cast one
    light_inside, ///< closed shells that contain the light cast no shadow
};
inline constexpr int limitation_count = 10;

/// The cause of a difference that a limitation explains.
Cause cause_of(Limitation limitation);

/// A set of them.
class Limitations {
public:
    constexpr Limitations() = default;
    constexpr Limitations(Limitation one) : bits_(bit(one)) {}

    constexpr bool contains(Limitation one) const { return (bits_ & bit(one)) != 0; }
    constexpr bool contains(Limitations others) const { return (others.bits_ & ~bits_) == 0; }
    constexpr bool empty() const { return bits_ == 0; }
    constexpr int size() const { return std::popcount(bits_); }
    constexpr Limitations operator|(Limitations other) const { return of(bits_ | other.bits_); }
    constexpr Limitations operator&(Limitations other) const { return of(bits_ & other.bits_); }
    constexpr Limitations operator-(Limitations other) const { return of(bits_ & ~other.bits_); }
    friend constexpr auto operator<=>(Limitations, Limitations) = default;

    /// One bit per limitation, the lowest for the first: how pictures store them.
    constexpr std::uint16_t bits() const { return bits_; }
    static constexpr Limitations of(unsigned bits) {
        Limitations set;
        set.bits_ = static_cast<std::uint16_t>(bits);
        return set;
    }

private:
    std::uint16_t bits_ = 0;
    static constexpr std::uint16_t bit(Limitation one) {
        return static_cast<std::uint16_t>(1U << static_cast<unsigned>(one));
    }
};
constexpr Limitations operator|(Limitation a, Limitation b) {
    return Limitations(a) | Limitations(b);
}

/// The members of a set, in order.
std::vector<Limitation> listed(Limitations limitations);

/// Those that decide which volumes are counted, not how.
inline constexpr Limitations of_volumes =
    Limitation::extrusion | Limitation::open_mesh | Limitation::light_inside;

/// How a technique counts, and what decides where faces are clipped.
struct CountingModel {
    Counting counting;
    DepthModel depth_model;
};

/// The limitations that a technique has, whatever the scene: all but alpha.
Limitations limitations_of(const CountingModel& model);

/// The technique without some of its limitations. Without near_clip the near plane is at the eye:
/// at depth 0, or at minus infinity; without far_clip the projection is infinite.
CountingModel without(CountingModel model, Limitations limitations);

} // namespace shadowproof
