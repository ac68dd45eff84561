// The three queries, for up to sixteen eye rays at a time: which surface is visible, whether it is
// lit, and how many light-facing triangles lie between a point and the light.
#pragma once

#include "reference/exact/predicates.h"
#include "reference/trace/packet.h"
#include "reference/trace/state.h"

#include <cstdint>

namespace shadowproof {

/// What an eye ray sees.
struct Seen {
    std::uint32_t triangle = no_triangle;
    double depth = 0;       ///< view depth, rounded; infinity where nothing is seen
    double depth_error = 0; ///< bound of its error
    Exactness exactness = Exactness::filtered;
};

/// Whether the visible point is lit.
struct Lighting {
    bool lit = false;
    bool in_cone = true; ///< of the spot light, if it is one
    Exactness exactness = Exactness::filtered;
};

/// The plane of a visible triangle, by which the depth along an eye ray is computed, with error
/// bounds; kept for the next rays that see the triangle.
struct SeenPlane {
    std::uint32_t triangle = no_triangle;
    glm::dvec3 normal{0, 0, 0};
    double normal_error = 0;    ///< per component
    double numerator = 0;       ///< (a - E) . normal
    double numerator_error = 0; ///< relative
};

/// Runs the queries of one thread. Lanes whose bit in `lanes` is not set are left unchanged.
class Prober {
public:
    explicit Prober(const Tracer::State& state, Filters filters = Filters::on);

    /// The nearest triangle within [near, far] along each direction D (view depth 1), and its
    /// depth.
    void see(const Lanes<glm::dvec3>& directions, std::uint32_t lanes, Lanes<Seen>& seen);
    /// The triangle alone, within any range.
    void see_triangle(const Lanes<glm::dvec3>& directions, std::uint32_t lanes,
                      const SeenRange& range, Lanes<Seen>& seen);

    /// Whether the light reaches the visible points.
    void light(const Lanes<glm::dvec3>& directions, std::uint32_t lanes, const Lanes<Seen>& seen,
               Lanes<Lighting>& lighting);

    /// Of the triangles that shadow the visible points those with the lowest numbers; no_triangle
    /// where there is none, or the light is behind the surface, or not asked for.
    void occluders(const Lanes<glm::dvec3>& directions, std::uint32_t lanes, const Lanes<Seen>& seen,
                   Lanes<std::uint32_t>& triangles);

    /// Counts light-facing triangles strictly between the point of each ray and the light; for a
    /// surface point, whose triangle is `skip`, the point just before it.
    struct Point {
        RayPoint::Kind kind = RayPoint::Kind::depth;
        double depth = 0;                 ///< where the kind is depth
        std::uint32_t skip = no_triangle; ///< the triangle of a surface point
    };
    void count(const Lanes<glm::dvec3>& directions, std::uint32_t lanes, const Lanes<Point>& points,
               Lanes<std::int32_t>& counts);

    std::uint64_t rays() const { return rays_; }
    std::uint64_t exact_decisions() const { return exact_decisions_; }

private:
    const Tracer::State* state_;
    Filters filters_;
    RecordCache seen_;
    RecordCache occluding_;
    RecordCache light_facing_;
    SeenPlane plane_;
    std::uint64_t rays_ = 0;
    std::uint64_t exact_decisions_ = 0;

    void measure_depth(const glm::dvec3& direction, Seen& seen);
    void set_shadow_ray(RayPacket& packet, int lane, const glm::dvec3& direction,
                        const Seen& seen) const;
    void ask_cone(const glm::dvec3& direction, const Seen& seen, Lighting& lighting);
};

} // namespace shadowproof
