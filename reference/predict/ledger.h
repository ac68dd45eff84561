// What each algorithm's counter should read at a pixel, derived from shadow depths s(Q): the number
// of light-facing triangles strictly between Q and the light, found by tracing.
#pragma once

#include "reference/trace/trace.h"
#include "scenes/frame.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// Shadow depths at those points of each pixel's eye ray that the formulas of the ledger need.
struct ShadowDepths {
    Image<std::int32_t> at_surface;  ///< just before the visible surface; 0 at background
    Image<std::int32_t> at_near;     ///< on the near plane
    Image<std::int32_t> at_far;      ///< on the far plane of `far`
    Image<std::int32_t> at_infinity; ///< light-facing triangles met from the light along the eye
                                     ///< ray's direction
    std::int32_t at_eye = 0; ///< of an orthographic camera: at the other end of all lines of sight
    double far = 0;          ///< the finite far plane of at_far
};

/// `far`: depth of the far plane of the techniques that have a finite one.
ShadowDepths count_shadow_depths(const Tracer& tracer, const GroundTruth& truth, double far);

/// The same with at_surface taken at the given view depth of each pixel; 0 where that is infinite.
ShadowDepths count_shadow_depths_at(const Tracer& tracer, const Image<double>& surface, double far);

/// At each pixel how many of the light-facing triangles between the visible surface and the light
/// let it through, as their masks leave them out there; 0 at background.
Image<std::int32_t> count_let_through(const Tracer& tracer, const GroundTruth& truth);
/// The same where a line of sight meets the triangle `seen`.
std::int32_t count_let_through(const Tracer& tracer, const glm::dvec3& line, std::uint32_t seen);

/// One crossing of an eye ray with the boundary of the shadow volumes.
struct Crossing {
    /// Which face: the side over the triangle's edge from corner k to the next, its light cap, or
    /// its dark cap where volumes are extruded to a finite distance.
    enum class Part : std::uint8_t { side_0, side_1, side_2, light_cap, dark_cap };
    double depth = 0; ///< view depth
    int change = 0;   ///< +1: entering a volume, -1: leaving it
    Part part = Part::light_cap;
    std::uint32_t triangle = no_triangle; ///< whose volume it is (one of them, where sides cancel)
    glm::dvec3 plane{0, 0, 0};            ///< normal of the face that is crossed, of any length
    std::uint32_t edge = 0; ///< of a side: its silhouette edge, in the order of Silhouette
    /// Of a side: its edge runs from a later position to an earlier one. Of a light cap: its
    /// triangle is flipped. Such faces are drawn after the others.
    bool flipped = false;

    bool is_side() const { return part < Part::light_cap; }
};

} // namespace shadowproof
