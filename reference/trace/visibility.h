// The three queries, for up to sixteen eye rays at a time: which surface is visible, whether it is
// lit, and how many light-facing triangles lie between a point and the light.
#pragma once

#include "reference/exact/predicates.h"
#include "reference/trace/packet.h"
#include "reference/trace/seen_planes.h"
#include "reference/trace/state.h"

#include <cstdint>

namespace shadowproof {

/// What eye rays see. Set by Prober::see for all lanes; what lanes without rays hold is arbitrary.
struct SeenLanes {
    alignas(64) Lanes<double> depth{};           ///< view depth, rounded; infinity: nothing is seen
    alignas(64) Lanes<double> depth_error{};     ///< bound of its error
    alignas(64) Lanes<std::uint32_t> triangle{}; ///< no_triangle where nothing is seen
    Lanes<Exactness> exactness{};
};

/// Whether the visible points are lit.
struct LitLanes {
    Lanes<Visibility> visibility{};
    Lanes<Exactness> exactness{};  ///< of that alone
    Lanes<std::uint8_t> in_cone{}; ///< of the spot light, if it is one
};

struct PacketRays;

/// How the rays of a packet read masks.
struct PacketMasks {
    Lanes<MaskReading> readings{};
    const MaskErrors* errors = nullptr;
};

/// Runs the queries of one thread. Lanes whose bit in `lanes` is not set are left unchanged.
class Prober {
public:
    explicit Prober(const Tracer::State& state, Filters filters = Filters::on);

    /// The nearest triangle within [near, far] along each line of sight (camera.h), and its depth.
    void see(const Vectors& lines, std::uint32_t lanes, SeenLanes& seen);
    /// The same within any range and, unless `masks` is null, as another program may read the masks
    /// on the way.
    void see(const Vectors& lines, std::uint32_t lanes, const SeenRange& range,
             const PacketMasks* masks, SeenLanes& seen);
    /// The triangle alone, within any range.
    void see_triangle(const Vectors& lines, std::uint32_t lanes, const SeenRange& range,
                      SeenLanes& seen);

    /// Whether the light reaches the visible points.
    void light(const Vectors& lines, std::uint32_t lanes, const SeenLanes& seen,
               LitLanes& lighting);

    /// Of the triangles that shadow the visible points those with the lowest numbers; no_triangle
    /// where there is none, or the light is behind the surface, or not asked for.
    void occluders(const Vectors& lines, std::uint32_t lanes, const SeenLanes& seen,
                   Lanes<std::uint32_t>& triangles);

    /// Counts light-facing triangles strictly between the point of each ray and the light; for a
    /// surface point, whose triangle is `skip`, the point just before it.
    struct Point {
        RayPoint::Kind kind = RayPoint::Kind::depth;
        double depth = 0;                 ///< where the kind is depth
        std::uint32_t skip = no_triangle; ///< the triangle of a surface point
    };
    enum class Masks : std::uint8_t {
        ignored, ///< a triangle counts as a whole
        kept,    ///< only where its mask leaves it standing
    };
    void count(const Vectors& lines, std::uint32_t lanes, const Lanes<Point>& points,
               Lanes<std::int32_t>& counts, Masks masks = Masks::ignored);

    std::uint64_t rays() const { return rays_; }
    std::uint64_t exact_decisions() const { return exact_decisions_; }
    std::uint64_t undecided() const { return undecided_; }

private:
    const Tracer::State* state_;
    Filters filters_;
    RecordCache seen_;
    RecordCache occluding_;
    RecordCache light_facing_;
    RecordCache light_facing_masked_;
    SeenPlanes planes_;
    RayPacket packet_;
    SeenRange own_range_;     ///< the camera's
    SeenRange range_{-1, -1}; ///< of which `limits_` are
    HitLimits limits_;        ///< where lines of sight meet in the eye
    std::uint64_t rays_ = 0;
    std::uint64_t exact_decisions_ = 0;
    std::uint64_t undecided_ = 0;
    const PacketMasks* leeway_ = nullptr; ///< of the query under way

    PacketRays packet_rays(const Vectors& lines) const;
    void set_shadow_rays(const Vectors& lines, std::uint32_t lanes, const SeenLanes& seen);
    Decision ask_cone(const glm::dvec3& line, std::uint32_t seen);
};

} // namespace shadowproof
