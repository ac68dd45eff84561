// Surfaces that lie so near the near or the far plane that floats decide whether they are seen
// there: exactly in it, say. The truth cuts at the plane itself; a driver may see such a surface,
// or what lies behind it.
#pragma once

#include "compare/driver/clipped_polygon.h"
#include "compare/driver/neighbourhood.h"
#include "compare/driver/plane_at_pixel.h"
#include "reference/trace/trace.h"
#include "scenes/depth_model.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace shadowproof {

/// By how much floats may move the planes that clip a triangle, in view depth. 0 where none clips.
struct ClipErrors {
    double near = 0;
    double far = 0;
};
ClipErrors clip_errors(const Scene& scene, std::uint32_t triangle, const Drawing& drawing);

/// Of planes that do not clip: how far off the depth may be by which a fragment is left out, as a
/// key, on a line of sight that meets its triangle.
double fragment_error(const DepthPicture& picture, std::uint32_t triangle, const PlaneAtPixel& at);

/// Of what a depth model draws. Keeps a reference to the tracer.
class CutSurfaces {
public:
    /// `far`: of the picture's projection, where that is finite.
    CutSurfaces(const Tracer& tracer, const DepthModel& model, double far);

    /// Whether no surface in the picture comes that near the planes.
    bool empty() const { return near_.surfaces.empty() && far_.surfaces.empty(); }

    /// Adds to neighbourhoods the rays along which such surfaces lie, once for each other surface
    /// that may be seen there, with the planes between which it is. `truths`: along the rays of all
    /// of them, one after the other, as trace_rays has them. Returns the same with those added.
    std::vector<RayTruth> look_aside(std::span<Neighbourhood> around, std::vector<RayTruth> truths,
                                     const MaskErrors* masks) const;

private:
    struct Surface {
        std::uint32_t triangle = no_triangle;
        double error = 0; ///< of where it is clipped
        SeenPlane plane;
    };
    struct Plane {
        double depth = 0;
        bool clips = false; ///< primitives; else fragments are left out by their depths
        std::vector<Surface> surfaces{}; ///< that lie next to it somewhere
    };
    /// A surface next to a plane on a line of sight.
    struct Met {
        std::uint32_t triangle = no_triangle;
        double beyond = 0;    ///< the plane, view depth
        bool is_open = false; ///< cut or not
    };
    /// A line of sight on which floats decide what is seen.
    struct OpenRay {
        std::size_t neighbourhood = 0;
        std::size_t ray = 0; ///< in it
        std::vector<Met> near{};
        std::vector<Met> far{};
    };

    const Tracer& tracer_;
    DepthPicture picture_;
    Plane near_;
    Plane far_;

    bool may_reach(const Plane& plane, std::uint32_t triangle) const;
    void find(std::uint32_t triangle, Plane& plane, double ClipErrors::*side) const;
    std::vector<Met> met(const Plane& plane, const glm::dvec3& line) const;
    std::vector<OpenRay> open_rays(std::span<const Neighbourhood> around) const;
    static std::optional<double> reach_of_open(std::span<const OpenRay> rays,
                                               std::vector<Met> OpenRay::*side);
    std::vector<SeenRange> moved_planes(std::span<const OpenRay> rays) const;
    bool may_see(const OpenRay& ray, const SeenRange& moved, const RayTruth& truth) const;
};

} // namespace shadowproof
