// The far ends of shadow volumes whose casters touch the light. Seen from the light, such a
// triangle fills half the sky, and an edge half a great circle: the directions of their corners
// alone do not tell which half. Additional directions in between do.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <vector>

namespace shadowproof {

/// Additional corners of the volumes' far ends, beside those of the casters' corners. Empty where
/// nothing touches the light. Equal positions are represented by the first of them. The maps give
/// indices into `directions`.
struct SplitFarEnds {
    /// From the light, normalised, with an error of a few 2^-53.
    std::vector<glm::dvec3> directions;
    /// By triangle: the direction to its point nearest to the light. The dark cap becomes a fan
    /// about it, whose parts do not overlap. Every triangle that faces the light and touches it has
    /// one.
    std::map<std::uint32_t, std::uint32_t> behind_triangle;
    /// By edge that touches the light, its lower position first: the direction to its point nearest
    /// to the light, where that is not one of its ends.
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> across_edge;
    /// By position so near the light that a difference of floats does not hold its direction: that
    /// direction, to be used instead.
    std::map<std::uint32_t, std::uint32_t> of_position;
    std::vector<std::uint32_t> welded; ///< the first of the positions that are equal; or empty

    bool empty() const { return directions.empty(); }
    /// Null where an edge, or a position, has no direction of its own.
    const std::uint32_t* across(std::uint32_t a, std::uint32_t b) const;
    const std::uint32_t* of(std::uint32_t position) const;
    const std::uint32_t* behind(std::uint32_t triangle) const;
};

/// Every triangle of `casters` must cast and face the light. Decided and computed in rational
/// numbers, so correct however near the light is.
SplitFarEnds split_far_ends(const Scene& casters);

/// The far end of a triangle, its corners in the triangle's order: a fan about the direction behind
/// it. `corner_of(position)` and `extra(direction)` number the fan's corners. Only for triangles
/// that have such a direction.
template <class CornerOf, class Extra>
std::vector<glm::uvec3> far_fan(const SplitFarEnds& split, std::uint32_t triangle,
                                const glm::uvec3& corners, const CornerOf& corner_of,
                                const Extra& extra) {
    std::vector<std::uint32_t> outline;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t own = corners[k];
        const std::uint32_t next = corners[(k + 1) % 3];
        outline.push_back(corner_of(own));
        if (const std::uint32_t* across = split.across(own, next))
            outline.push_back(extra(*across));
    }
    const std::uint32_t middle = extra(*split.behind(triangle));
    std::vector<glm::uvec3> fan;
    for (std::size_t i = 0; i < outline.size(); ++i)
        fan.emplace_back(middle, outline[i], outline[(i + 1) % outline.size()]);
    return fan;
}

/// Points that stand for the directions' ends at infinity. Each is as far from the light as the
/// light is from the origin, so that rounding it to float loses no more than rounding a corner.
std::vector<glm::vec3> points_towards_infinity(const Scene& scene, const SplitFarEnds& split);

/// (a - l) x (b - a) for a point light at l, normalised: the normal of the plane through the light
/// and an edge, as exact as the directions above. Zero where the light is on the edge's line.
glm::dvec3 normal_through_light(const glm::dvec3& light, const glm::dvec3& a, const glm::dvec3& b);

/// For each direction the point at this distance from the light, rounded to float.
std::vector<glm::vec3> points_along(const Scene& scene, const SplitFarEnds& split, double distance);

} // namespace shadowproof
