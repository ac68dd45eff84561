// The points around a pixel's centre that may be drawn there in its stead, and which surfaces may
// cover it once their corners are moved so far.
#pragma once

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace shadowproof {

/// How far a pixel's neighbourhood reaches to each side, in pixels.
struct BandRadius {
    double surface = 0; ///< for what is seen
    double nearest = 0; ///< for the nearest face that is counted, which may move further
};

/// Rays through the points at which a pixel's neighbourhood is looked at.
struct Neighbourhood {
    std::vector<glm::dvec3> rays;        ///< the pixel's centre first, then a grid to each radius
    double reach = 0;                    ///< the larger radius, pixels
    std::array<glm::dvec3, 4> corners{}; ///< of the larger grid, around it: what is linear is
                                         ///< extreme there
};
/// `centre`: a place of the picture, in pixels from its top left corner.
Neighbourhood neighbourhood(const Camera& camera, const glm::dvec2& centre,
                            const BandRadius& radius);

/// A ray within each of the parts into which planes through the eye divide the neighbourhood, of
/// those that lie next to such a plane: however thin, they may be drawn at the pixel. Of many
/// planes, those that pass next to the pixel's centre.
std::vector<glm::dvec3> rays_between(const Neighbourhood& around, std::vector<glm::dvec3> planes);

/// Largest difference of a ray's component from the centre's.
double spread(const Neighbourhood& around);

/// Whether the triangle may cover the picture point of `direction` with corners moved by up to
/// `freedom` a component of a direction. An edge seen from the eye spans a plane; the point lies on
/// its inner side, or no further out than its ends can move: |plane|_1 freedom. Corners behind the
/// eye need no care, as nothing is divided.
bool may_cover(const Scene& scene, std::uint32_t triangle, const glm::dvec3& direction,
               double freedom);

/// Whether what lies behind triangles may be seen between them at a pixel, though none of its rays
/// passes: those that share edges move together, so that no gap opens where such a group covers all
/// rays; but groups that only touch move apart (a T-junction's crack).
bool may_gape(const Scene& scene, std::vector<std::uint32_t> triangles,
              std::span<const glm::dvec3> rays);

} // namespace shadowproof
