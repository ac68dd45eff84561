// Sixteen rays from one origin through the hierarchy, in float with error bounds: what floats
// cannot decide is passed on, lane by lane, to be decided exactly. Uses the widest vectors that the
// processor has; the result is the same with any.
#pragma once

#include "reference/exact/exactness.h"
#include "reference/trace/records.h"

#include <array>
#include <cstdint>
#include <limits>

namespace shadowproof {

inline constexpr int packet_size = 16;

/// A plane in which no triangle lies.
inline constexpr std::uint32_t no_plane = 0xffffffffU;

template <class T>
using Lanes = std::array<T, packet_size>;

/// An approximation of a ray's exact direction w: |w - direction| <= error in each component.
struct ApproximateDirection {
    glm::dvec3 direction{0, 0, 0};
    double error = 0;
};

/// Rays are O + s w, O the view's origin, with coordinates scaled as in the view. A hit must have
/// 1/s above `lower` and below `upper`, each known to lie in an interval [lo, hi]. Parallel rays
/// run up at (u, v): w = (u, v, 1), and heights take the place of 1/s. What is computed from the
/// inputs of set_lane, and its bounds, are explained in packet.cpp.
struct RayPacket {
    alignas(64) Lanes<float> x{}, y{}, z{};    ///< w, 1 <= |w| <= 2, |w| the largest component
    alignas(64) Lanes<float> error{};          ///< of a component of w; infinite: w is unknown
    alignas(64) Lanes<float> unit{};           ///< w over the direction given: a power of two
    alignas(64) Lanes<float> rx{}, ry{}, rz{}; ///< 1 / w; parallel: u, v, and the least height
    alignas(64) Lanes<float> magnitude{};      ///< |w|; infinite: floats decide nothing
    alignas(64) Lanes<float> lower_lo{}, lower_hi{};
    alignas(64) Lanes<float> upper_lo{}, upper_hi{};
    alignas(64) Lanes<float> farthest{};        ///< boxes beyond are skipped; -1: lane is done
    alignas(64) Lanes<std::uint32_t> skip{};    ///< a plane (Places) to ignore, or no_plane
    alignas(64) Lanes<std::uint32_t> hit{};     ///< nearest or any, or no_triangle
    alignas(64) Lanes<std::uint32_t> crossed{}; ///< number of triangles met
    float pad = 0;                              ///< by how much boxes are enlarged
    std::uint32_t active = 0;                   ///< one bit per lane that is not done
    /// The largest error with which floats may decide: below 0, nothing is left to them.
    float trusted_error = 0x1p-25F;
};

/// A packet without rays.
RayPacket empty_packet(Filters filters = Filters::on);

/// Sets a lane's ray and activates it. `limits`: 1/s in units of the direction as given. `skip`: a
/// plane whose triangles are ignored, or no_plane.
struct HitLimits {
    float lower_lo = 0, lower_hi = 0;
    float upper_lo = std::numeric_limits<float>::infinity();
    float upper_hi = std::numeric_limits<float>::infinity();
};
void set_lane(RayPacket& packet, int lane, const ApproximateDirection& w, const HitLimits& limits,
              std::uint32_t skip);

/// Ends the search of a lane's ray.
void finish_lane(RayPacket& packet, int lane);

/// From now on ignores hits with 1/s below this, in units of the direction given.
void raise_lower_limit(RayPacket& packet, int lane, float lo, float hi);

/// Decides what floats could not: whether a lane's ray meets the triangle within its limits.
/// Records the consequence (packet.hit and limits, finish_lane, or packet.crossed).
class Arbiter {
public:
    Arbiter() = default;
    Arbiter(const Arbiter&) = delete;
    Arbiter& operator=(const Arbiter&) = delete;
    virtual ~Arbiter() = default;
    virtual void decide(RayPacket& packet, int lane, std::uint32_t triangle) = 0;
};

/// packet.hit: the triangle with the largest 1/s. Not for parallel rays.
void find_nearest(RayPacket& packet, RecordCache& records, Arbiter& arbiter);
/// packet.hit: some triangle; the lane is then done.
void find_any(RayPacket& packet, RecordCache& records, Arbiter& arbiter);
/// packet.crossed: how many triangles.
void count_all(RayPacket& packet, RecordCache& records, Arbiter& arbiter);

} // namespace shadowproof
