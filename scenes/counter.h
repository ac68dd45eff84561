// The counter of shadow volumes: how a technique counts, from which its counter is predicted, and
// the counter that was read back.
#pragma once

#include "scenes/image.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// How a stencil technique counts the faces of the shadow volumes at a pixel.
struct Counting {
    enum class Test : std::uint8_t {
        depth_pass, ///< faces in front of the surface: front +1, back -1
        depth_fail, ///< faces behind the surface: back +1, front -1
    };
    Test test = Test::depth_fail;
    /// What a counted face does to the counter.
    enum class Operation : std::uint8_t {
        wrap,     ///< one more or less, modulo 2^bits
        saturate, ///< one more or less, but never past 0 and 2^bits - 1
        invert,   ///< all bits are inverted: only the parity of the count is kept
    };
    Operation operation = Operation::wrap;
    /// What the counter holds before any face is counted.
    enum class Start : std::uint8_t {
        zero,
        eye,        ///< the number of volumes around the eye
        near_plane, ///< the number of volumes around the pixel's point on the near plane
    };
    Start start = Start::zero;
    bool light_cap = true; ///< the light-facing triangles themselves are drawn
    bool dark_cap = true;  ///< they are also drawn at infinity, where the projection keeps them
    /// Dark caps at infinity are counted before all faces, not after sides and caps: where parallel
    /// lines of sight end, all or none of them are met.
    bool caps_first = false;
    int bits = 8;              ///< of the counter
    bool holes_filled = false; ///< open casters are closed before volumes are made of them
    /// Which triangles of casters are flipped (their winding reversed) before volumes are made of
    /// them. A shell is a set of triangles connected by shared edges.
    struct Flips {
        /// All triangles of closed shells, wound outwards, that contain the light. Perhaps none of
        /// them faces the light, and yet the shell shadows everything outside it.
        bool around_light = false;
        /// Of other shells, the triangles that face away from the light: flipped, each casts a
        /// shadow by itself.
        enum class Averted : std::uint8_t {
            none,
            of_faulty_shells, ///< of those that are not both closed and wound outwards
            of_all_shells,
        };
        Averted averted = Averted::none;
        friend bool operator==(const Flips&, const Flips&) = default;
    };
    Flips flips{};
    /// How far the volumes extend beyond their casters, away from the light, in world units; may be
    /// infinite.
    double extrusion = std::numeric_limits<double>::infinity();

    /// How one caster is counted, where not all are counted alike.
    struct Caster {
        Test test = Test::depth_fail;
        bool left_out = false; ///< it has no volume
        bool light_cap = true;
        bool dark_cap = true;
        friend bool operator==(const Caster&, const Caster&) = default;
    };
    /// One per triangle of the scene; empty: all as above. Otherwise `light_cap` and `dark_cap`
    /// above are true: only caps that make no difference are left out.
    std::vector<Caster> casters{};

    Caster caster(std::uint32_t triangle) const {
        if (triangle < casters.size()) return casters[triangle];
        return {test, false, light_cap, dark_cap};
    }
};

/// The counter as a buffer of `counting.bits` bits stores it. A saturating count must have been
/// clamped at every step already.
inline std::uint32_t stored(std::int64_t count, const Counting& counting) {
    const std::int64_t most = (std::int64_t{1} << counting.bits) - 1;
    if (counting.operation == Counting::Operation::invert) count = (count & 1) != 0 ? most : 0;
    return static_cast<std::uint32_t>(count & most);
}

/// How a technique that counts in front of the surface compensates for what the near plane clips.
enum class NearPlane : std::uint8_t {
    lost,       ///< not at all
    capped,     ///< volumes are closed on the near plane; needs a finite projection
    from_light, ///< the occluders between light and near plane are drawn from the light
};

/// Which faces a technique draws as the volumes of its casters, beyond what Counting says. Its
/// figures and its picture of the volumes are predicted from this.
struct VolumeFaces {
    /// Which edges of light-facing triangles are extruded to sides.
    enum class Sides : std::uint8_t {
        surplus,    ///< edges that more of these triangles run in one direction than in the other,
                    ///< once per surplus triangle
        half_edges, ///< each half-edge whose twin (half_edge.h) is missing or does not face
                    ///< the light
        all,        ///< all three of every triangle
    };
    Sides sides = Sides::surplus;
    /// Shaders decide in double which triangles face the light, where the CPU computes an exact
    /// sign. Triangles that Counting::flips flips are left to the CPU, as casters of their own; so
    /// is everything where some caster touches the light (touching_light.h).
    bool by_shaders = false;
    NearPlane near_plane = NearPlane::lost;
    /// One flag per triangle of the scene: its light cap is not drawn where faces in front of the
    /// surface are counted. Empty: all light caps are drawn.
    std::vector<std::uint8_t> hidden_caps{};
};

/// What a technique saved, compared with drawing everything.
struct Savings {
    std::string against;     ///< the technique that draws everything
    double milliseconds = 0; ///< per frame
    std::int64_t volume_fragments = 0;
    double plan_milliseconds = 0; ///< spent once on deciding what to leave out
};

/// The evidence of a claim made by shadow volumes.
struct CounterEvidence {
    Image<std::uint32_t> counter; ///< as read back, before the light pass
    Counting counting;
    VolumeFaces volume_faces{};
    std::uint64_t volume_fragments = 0; ///< of all volume faces, hidden or not
    /// A picture of the volumes: how many of their faces are not behind the visible surface, at
    /// most 255.
    Image<std::uint8_t> volumes;
    std::optional<Savings> saved; ///< by leaving out what the scene did not need
};

} // namespace shadowproof
