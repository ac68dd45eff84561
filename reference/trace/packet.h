// Sixteen rays from one origin and the clusters that Embree's walk finds for them, in float with
// error bounds: what floats cannot decide is passed on, lane by lane, to be decided exactly. Uses
// the widest vectors that the processor has. What is found does not depend on them, nor on the
// order in which clusters are found.
#pragma once

#include "reference/exact/exactness.h"
#include "reference/trace/records.h"

#include <array>
#include <cstdint>
#include <limits>

namespace shadowproof {

/// A plane in which no triangle lies.
inline constexpr std::uint32_t no_plane = 0xffffffffU;

/// An approximation of a ray's exact direction w: |w - direction| <= error in each component.
struct ApproximateDirection {
    glm::dvec3 direction{0, 0, 0};
    double error = 0;
};

/// Limits of 1/s, in units of the direction as given.
struct HitLimits {
    float lower_lo = 0, lower_hi = 0;
    float upper_lo = std::numeric_limits<float>::infinity();
    float upper_hi = std::numeric_limits<float>::infinity();
};

/// Rays are O + s w, O the view's origin, with coordinates scaled as in the view. A hit must have
/// 1/s above `lower` and below `upper`, each known to lie in an interval [lo, hi]. Parallel rays
/// run up at (u, v): w = (u, v, 1), and heights take the place of 1/s. What is computed from the
/// inputs of set_lane, and its bounds, are explained in rays.cpp.
struct RayPacket {
    // As given.
    Vectors direction;
    alignas(64) Lanes<double> direction_error{};
    alignas(64) Lanes<float> lower_lo{}, lower_hi{}; ///< when prepared, in units of w
    alignas(64) Lanes<float> upper_lo{}, upper_hi{};
    alignas(64) Lanes<std::uint32_t> skip{}; ///< a plane (Places) to ignore, or no_plane
    std::uint32_t active = 0;                ///< one bit per lane that is not done
    /// The largest error with which floats may decide: below 0, nothing is left to them.
    static constexpr float usual_trusted_error = 0x1p-25F;
    float trusted_error = usual_trusted_error;

    // What floats compute with.
    alignas(64) std::array<Lanes<float>, 3> w{}; ///< 1 <= |w| < 2, |w| the largest component
    alignas(64) Lanes<float> unit{};             ///< w over the direction: a power of two
    alignas(64) Lanes<float> magnitude{};        ///< |w|; infinite: floats decide nothing
    std::array<float, 3> least_w{};              ///< of the lanes that have rays, by component
    std::array<float, 3> most_w{};
    float most_magnitude = 0;
    WalkRays walk;
    alignas(64) Lanes<double> walk_start{}; ///< s at which the walk's ray begins
    double room = 0;                        ///< how far rays may be from the walk's

    // What is found.
    alignas(64) Lanes<std::uint32_t> hit{};     ///< nearest or any, or no_triangle
    alignas(64) Lanes<float> hit_hi{};          ///< nearest: 1/s of the hit is at most this
    alignas(64) Lanes<float> best_lo{};         ///< nearest: 1/s of the nearest is at least this
    bool best_raised = false;                   ///< since the walk's limits were last lowered
    alignas(64) Lanes<std::uint32_t> crossed{}; ///< number of triangles met
};

/// Makes a packet one without rays. What lanes without rays hold does not matter.
void clear(RayPacket& packet, Filters filters = Filters::on);

/// Sets a lane's ray and activates it. `skip`: a plane whose triangles are ignored, or no_plane.
void set_lane(RayPacket& packet, int lane, const ApproximateDirection& w, const HitLimits& limits,
              std::uint32_t skip);
/// The same for many lanes, whose directions are exact; nothing is ignored.
void set_lanes(RayPacket& packet, std::uint32_t lanes, const Vectors& directions,
               const HitLimits& limits);

/// Decides what floats could not.
class Arbiter {
public:
    Arbiter() = default;
    Arbiter(const Arbiter&) = delete;
    Arbiter& operator=(const Arbiter&) = delete;
    virtual ~Arbiter() = default;
    /// Whether the lane's ray meets the triangle within its limits is not known; if it does, 1/s is
    /// at most `hi`, which may be no number. May raise best_lo, count in `crossed`, or end the
    /// lane's search.
    virtual void decide(RayPacket& packet, int lane, std::uint32_t triangle, float hi) = 0;
    /// Nearest: the triangle is met, with 1/s in [lo, hi], as may be the hit.
    virtual void compare(RayPacket& /*packet*/, int /*lane*/, std::uint32_t /*triangle*/,
                         float /*lo*/, float /*hi*/) {}
    /// All triangles have been found: settles what was left for the end.
    virtual void settle(RayPacket& /*packet*/) {}
};

/// packet.hit: the triangle with the largest 1/s, or the highest where rays are parallel.
void find_nearest(RayPacket& packet, RecordCache& records, Arbiter& arbiter);
/// packet.hit: some triangle that is certainly met; the lane is then done. The arbiter adds what
/// remains.
void find_any(RayPacket& packet, RecordCache& records, Arbiter& arbiter);
/// packet.hit: of those that are certainly met the one with the lowest number.
void find_lowest(RayPacket& packet, RecordCache& records, Arbiter& arbiter);
/// packet.crossed: how many triangles.
void count_all(RayPacket& packet, RecordCache& records, Arbiter& arbiter);

} // namespace shadowproof
