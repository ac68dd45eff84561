// Planes through the eye, by which edges and vertices divide the lines of sight of a picture.
#pragma once

#include "scenes/camera.h"

#include <array>
#include <glm/vec3.hpp>

namespace shadowproof {

/// On which side of a plane through the eye a line of sight (camera.h) runs: a function that is
/// linear in its direction or, where the eye is at infinity, affine in its start.
struct SightPlane {
    glm::dvec3 normal{0, 0, 0};
    double offset = 0; ///< 0 where the eye is a place

    double side(const glm::dvec3& line) const {
        return line.x * normal.x + line.y * normal.y + line.z * normal.z + offset;
    }
};

/// v x (eye - p), not normalised, for a p that may be next to the eye: the plane through the eye,
/// p, and what lies from p in the direction v. An eye in the direction -D takes the place of
/// eye - p. Where all is on one line, that of the eye as the predicates move it (predicates.h).
SightPlane plane_through_eye(const Camera& camera, const glm::dvec3& v, const glm::dvec3& p);

/// The plane through the eye and an edge: D . (a - eye) x (b - eye), or D . (a - S) x (b - S), the
/// same for both directions of the edge, and moved likewise.
SightPlane edge_plane(const Camera& camera, const glm::dvec3& a, const glm::dvec3& b);

/// Which signs a plane has over the lines of sight between four of them: what holds at no corner of
/// a rectangle holds nowhere in it.
struct Signs {
    bool some_negative = false;
    bool some_positive = false; ///< or zero

    Signs(const std::array<glm::dvec3, 4>& corners, const SightPlane& plane) {
        for (const glm::dvec3& corner : corners)
            (plane.side(corner) < 0 ? some_negative : some_positive) = true;
    }
    bool mixed() const { return some_negative && some_positive; }
};

} // namespace shadowproof
