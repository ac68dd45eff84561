// Outlines that the clipper's floats may draw far aside: of triangles that reach far beyond the
// picture, and of the sides of their volumes.
#pragma once

#include "compare/clipped_polygon.h"
#include "reference/region_ledger.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowproof {

class CoarseOutlines {
public:
    /// Of all triangles of a scene, and of the sides over its silhouette. `far_ends`: where
    /// casters' positions lie once extruded, null where that is at infinity.
    CoarseOutlines(const Scene& scene, const Silhouette& silhouette,
                   const std::vector<glm::vec3>* far_ends, const Drawing& drawing);

    /// How far, in pixels, outlines may be drawn aside that may then pass within `reach` of a place
    /// of the picture, in pixels; zero where none does.
    double reach_at(const glm::dvec2& place, double reach) const;

private:
    struct Outline {
        PicturePoint from, to; ///< one of them at least is made by clipping
    };
    std::vector<Outline> outlines_; ///< those first that may be moved furthest

    void add(const std::vector<PicturePoint>& polygon);
};

} // namespace shadowproof
