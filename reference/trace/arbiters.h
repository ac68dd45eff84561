// The arbiters of the three queries of visibility.h: they decide exactly, by the signs of
// predicates.h, what the floats of a packet could not.
#pragma once

#include "reference/exact/predicates.h"
#include "reference/trace/packet.h"
#include "reference/trace/records.h"
#include "reference/trace/state.h"
#include "reference/trace/visibility.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

class Signs;

/// The rays of a packet as all arbiters see them, and how many signs needed exact arithmetic.
struct PacketRays {
    const Tracer::State* state = nullptr;
    const Vectors* lines = nullptr; ///< of sight
    Predicates predicates;
    Filters filters = Filters::on;
    const PacketMasks* leeway = nullptr; ///< null: masks are read exactly
    std::uint64_t exact_decisions = 0;   ///< of triangles that are met
    std::uint64_t undecided = 0;         ///< how often floats left a triangle to an arbiter

    EyeRay ray(int lane) const { return state->ray((*lines)[static_cast<std::size_t>(lane)]); }
    Corners triangle(std::uint32_t index) const { return corners(*state->scene, index); }
};

/// Whether a triangle lies between a visible point and the light, exactly.
struct Occlusion {
    bool touched = false; ///< no sign was strictly against it
    bool blocks = false;
    Exactness exactness = Exactness::filtered;
    std::uint64_t exact_decisions = 0;
};

/// Decides which triangle an eye ray meets first. What is recorded of it (exactness, number of
/// exact signs) follows from the triangles that are truly met, where floats cannot tell that
/// another is nearer: so it does not depend on the order in which they are found. Keeps references.
class NearestArbiter final : public Arbiter {
public:
    NearestArbiter(PacketRays& rays, const SeenRange& range, SeenLanes& seen)
        : rays_(rays), range_(range), seen_(seen) {}

    void decide(RayPacket& packet, int lane, std::uint32_t triangle, float hi) override;
    void compare(RayPacket& packet, int lane, std::uint32_t triangle, float lo, float hi) override;
    void settle(RayPacket& packet) override;

private:
    /// A triangle that is met and may be the nearest.
    struct Candidate {
        int lane = 0;
        std::uint32_t triangle = no_triangle;
        float hi = 0; ///< of 1/s
        Exactness exactness = Exactness::filtered;
        std::uint64_t exact_decisions = 0;
        std::array<bool, 3> through{}; ///< the ray runs through the lines of these edges
    };

    PacketRays& rays_;
    const SeenRange& range_;
    SeenLanes& seen_;
    std::uint32_t at_vertex_ = 0; ///< one bit per lane whose ray is known to run through a vertex
    Lanes<glm::dvec3> vertex_;    ///< of those lanes
    std::vector<Candidate> candidates_;
    std::size_t many_ = 256; ///< of them: time to leave out those that are none any more

    bool runs_through(int lane, const glm::dvec3& vertex) const {
        return (at_vertex_ >> lane & 1U) != 0 && vertex_[static_cast<std::size_t>(lane)] == vertex;
    }
    void add(RayPacket& packet, const Candidate& candidate, float lo);
    std::optional<Candidate> met(int lane, std::uint32_t triangle);
    void settle_lane(RayPacket& packet, std::span<const Candidate> candidates);

    /// Predicates::edge; edges at a vertex that the ray runs through are all met.
    Decision edge(const EyeRay& ray, int lane, const glm::dvec3& a, const glm::dvec3& b) const;

    /// Whether the ray meets both triangles in one point because they share it: the vertex that it
    /// runs through, or an edge.
    bool meet_there(const Candidate& candidate, std::uint32_t other) const;

    bool within_planes(const EyeRay& ray, const Corners& t, Signs& signs) const;
    bool stands(const EyeRay& ray, int lane, std::uint32_t triangle, Signs& signs) const;
};

/// Decides whether a triangle lies between a visible point and the light: last, as floats may find
/// another that certainly does; then in ascending order. So nothing that is recorded depends on the
/// order in which triangles are found. Keeps references.
class AnyArbiter final : public Arbiter {
public:
    AnyArbiter(PacketRays& rays, const SeenLanes& seen, LitLanes& lighting)
        : rays_(rays), seen_(seen), lighting_(lighting) {}

    void decide(RayPacket& packet, int lane, std::uint32_t triangle, float hi) override;
    void settle(RayPacket& packet) override;

private:
    struct Candidate {
        int lane = 0;
        std::uint32_t triangle = no_triangle;
        std::optional<Occlusion> occlusion{}; ///< once decided
    };

    PacketRays& rays_;
    const SeenLanes& seen_;
    LitLanes& lighting_;
    std::vector<Candidate> candidates_;
    std::size_t many_ = 256; ///< of them: time to decide, and leave out what is beside

    void leave_out_what_is_beside();
};

/// Finds the lowest-numbered triangle between a visible point and the light. Keeps references.
class LowestArbiter final : public Arbiter {
public:
    LowestArbiter(PacketRays& rays, const SeenLanes& seen) : rays_(rays), seen_(seen) {}

    void decide(RayPacket& packet, int lane, std::uint32_t triangle, float hi) override;

private:
    PacketRays& rays_;
    const SeenLanes& seen_;
};

/// Decides which triangles lie between a point of a ray and the light, with ties broken. Keeps
/// references.
class CountArbiter final : public Arbiter {
public:
    CountArbiter(PacketRays& rays, const Lanes<Prober::Point>& points, const RecordCache& records,
                 Prober::Masks masks)
        : rays_(rays), points_(points), records_(records),
          keeps_masks_(masks == Prober::Masks::kept) {}

    void decide(RayPacket& packet, int lane, std::uint32_t triangle, float hi) override;

private:
    PacketRays& rays_;
    const Lanes<Prober::Point>& points_;
    const RecordCache& records_;
    bool keeps_masks_;

    /// Whether a point is behind a cap. A surface in the cap's plane is not. The eye is always on
    /// one side or the other: a ray from there has left the volume it began in, or has not.
    Decision behind(const EyeRay& ray, const RayPoint& q, const Corners& t) const;

    RayPoint exact_point(const Prober::Point& point) const;
};

} // namespace shadowproof
