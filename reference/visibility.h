// The three questions, for up to sixteen eye rays at a time: what is seen, is it lit, and how many
// light-facing triangles lie between a point and the light.
#pragma once

#include "reference/packet.h"
#include "reference/predicates.h"
#include "reference/state.h"

#include <cstdint>

namespace shadowproof {

/// What an eye ray sees.
struct Seen {
    std::uint32_t triangle = no_triangle;
    double depth = 0;       ///< view depth, rounded; infinity where nothing is seen
    double depth_error = 0; ///< bound of its error
    Exactness exactness = Exactness::filtered;
};

/// Whether the seen point is lit.
struct Lighting {
    bool lit = false;
    bool in_cone = true; ///< of the spot light, if it is one
    std::uint32_t occluder = no_triangle;
    Exactness exactness = Exactness::filtered;
};

/// Plane of a triangle through the eye ray's depth, with bounds; kept while rays see it again.
struct SeenPlane {
    std::uint32_t triangle = no_triangle;
    glm::dvec3 normal{0, 0, 0};
    double normal_error = 0;    ///< of a component
    double numerator = 0;       ///< (a - E) . normal
    double numerator_error = 0; ///< relative
};

/// One thread's means of asking. Lanes whose bit in `lanes` is not set are left alone.
class Prober {
public:
    explicit Prober(const Tracer::State& state);

    /// Nearest triangle within [near, far] along each direction D (view depth 1).
    void see(const Lanes<glm::dvec3>& directions, std::uint32_t lanes, Lanes<Seen>& seen);

    /// For what was seen: whether the light reaches it.
    void light(const Lanes<glm::dvec3>& directions, std::uint32_t lanes, const Lanes<Seen>& seen,
               Lanes<Lighting>& lighting);

    /// Light-facing triangles strictly between the point of each ray and the light; for a surface
    /// point, whose triangle is `skip`, just before it.
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
    RecordCache seen_;
    RecordCache occluding_;
    RecordCache light_facing_;
    SeenPlane plane_;
    std::uint64_t rays_ = 0;
    std::uint64_t exact_decisions_ = 0;

    void measure_depth(const glm::dvec3& direction, Seen& seen);
    void ask_cone(const glm::dvec3& direction, const Seen& seen, Lighting& lighting);
};

} // namespace shadowproof
