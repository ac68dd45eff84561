// The points around a pixel's centre that may be drawn in its place, and the surfaces that may
// cover it when their corners are moved by as much.
#pragma once

#include "reference/predict/sight_plane.h"
#include "reference/trace/trace.h"
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

/// Rays through the sample points of a pixel's neighbourhood.
struct Neighbourhood {
    std::vector<glm::dvec3> rays; ///< the pixel's centre first, then one grid for each radius
    std::vector<MaskReading> readings{}; ///< of masks, one per ray; empty: all are exact
    std::vector<SeenRange> moved{};      ///< the planes of the last rays (cut_surfaces.h)
    double reach = 0;                    ///< the larger radius, pixels
    std::array<glm::dvec3, 4> corners{}; ///< rays around the larger grid: bounds of what is linear

    /// Whether a ray sees between planes that are not the camera's own.
    bool is_moved(std::size_t ray) const { return ray + moved.size() >= rays.size(); }
    SeenRange planes_of(const Camera& camera, std::size_t ray) const {
        return is_moved(ray) ? moved[ray + moved.size() - rays.size()] : range_of(camera);
    }
};
/// `centre`: a place of the picture, in pixels from its top left corner.
Neighbourhood neighbourhood(const Camera& camera, const glm::dvec2& centre,
                            const BandRadius& radius);

/// In scenes with masks: each ray three times, with each of the readings.
void read_masks_in_all_ways(Neighbourhood& around);

/// Planes through the eye divide the neighbourhood into parts. Gives one ray within each part that
/// lies next to a plane: however thin, such a part may be drawn at the pixel. If there are many
/// planes, only those that pass next to the pixel's centre are used.
std::vector<glm::dvec3> rays_between(const Neighbourhood& around,
                                     const std::vector<SightPlane>& planes);

/// Whether some ray has a visibility: along it, or where floats move the planes that cut surfaces.
struct SeenAround {
    bool truly = false;
    bool by_planes = false;
};
SeenAround seen_around(const Neighbourhood& around, std::span<const RayTruth> truth,
                       Visibility visibility);

/// Largest difference of a ray's component from the centre's.
double spread(const Neighbourhood& around);

/// Whether the triangle may cover the picture point of a line of sight with corners moved by up to
/// `error` a component of such a line. An edge seen from the eye spans a plane; the point lies on
/// its inner side, or no further out than its ends can move: |plane|_1 error. Corners behind the
/// eye are no special case, because nothing is divided.
bool may_cover(const Scene& scene, std::uint32_t triangle, const glm::dvec3& line, double error);

/// Whether what lies behind triangles may be seen through a gap between them at a pixel, though
/// none of its rays passes. Triangles that share edges move together: no gap opens where such a
/// group covers all rays. Groups that only touch may move apart (a T-junction's crack).
bool may_gape(const Scene& scene, std::vector<std::uint32_t> triangles,
              std::span<const glm::dvec3> rays);

} // namespace shadowproof
