// Outlines that the clipper's float errors may displace far: those of triangles that reach far
// beyond the picture, and of the sides of their volumes.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "compare/driver/setup_error.h"
#include "reference/predict/region_ledger.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace shadowproof {

/// Whether the clipper's float errors may displace a triangle off a pixel that it covers, so that
/// what lies behind it is seen there.
bool may_be_displaced(const Scene& scene, std::uint32_t triangle, const CoveredPixel& pixel);

class CoarseOutlines {
public:
    /// Of all triangles of a scene, and of the sides over its silhouette; null: no volumes are
    /// drawn. `far_ends`: where casters' positions lie once extruded, null where that is at
    /// infinity.
    CoarseOutlines(const Scene& scene, const Silhouette* silhouette,
                   const std::vector<glm::vec3>* far_ends, const Drawing& drawing);

    /// Places, in pixels, on either side of the outlines that may be displaced as far as `place`,
    /// each a step from the outline's nearest point: what is true there may be drawn at `place`. If
    /// there are more than `most`, those across the outlines that may be displaced furthest.
    std::vector<glm::dvec2> places_across(const glm::dvec2& place, double step,
                                          std::size_t most) const;

    /// Whether some outline may be displaced by more than `step`, and within a step of `place`.
    bool may_reach(const glm::dvec2& place, double step) const;

private:
    struct NearPlace {
        glm::dvec2 nearest; ///< the outline's point next to a place
        glm::dvec2 along;   ///< of length 1
        double aside = 0;   ///< how far it may be displaced there
    };
    struct Outline {
        PicturePoint from, to; ///< one of them at least is made by clipping
    };
    std::vector<Outline> outlines_; ///< furthest displacement first

    void add(const std::vector<PicturePoint>& polygon);
    void add_volumes(const Scene& scene, const Silhouette& silhouette,
                     const std::vector<glm::vec3>* far_ends, const Drawing& drawing);
    /// None where the outline may not be displaced within `step` of the place.
    static std::optional<NearPlace> near(const Outline& outline, const glm::dvec2& place,
                                         double step);
};

} // namespace shadowproof
