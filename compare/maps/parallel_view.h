// The casters as a light at infinity sees them, which draws its map in parallel projection.
#pragma once

#include "compare/maps/caster_grid.h"
#include "compare/maps/light_view.h"
#include "compare/maps/pictured_caster.h"
#include "compare/maps/polygon_offset.h"
#include "reference/trace/first_met.h"

#include <cmath>
#include <glm/vec2.hpp>

namespace shadowproof {

class ParallelView final : public LightView {
public:
    ParallelView(const Scene& scene, const MapEvidence& map, int subpixel_bits, int threads);

    void trace(std::span<const Texel> texels, const FoundTriangle& found) const override;
    std::vector<FromLight> trace_without(const LiftedLimits& lifted,
                                         std::span<const Texel> texels) const override;
    std::vector<FromLight> trace_to(std::span<const PointOnFace> points,
                                    const LiftedLimits& lifted) const override;
    Shown showing(const Texel& texel, std::uint32_t triangle) const override;
    double moved_away(const Texel& texel, std::uint32_t triangle, double depth) const override;

private:
    /// A caster's plane at a texel's centre.
    struct Plane {
        double depth = 0;
        double slope = 0; ///< change of the depth over a texel's step, of both axes in sum
        bool has_depth() const { return std::isfinite(depth) && std::isfinite(slope); }
    };

    Scene casters_;                        ///< alone
    std::vector<std::uint32_t> of_scene_;  ///< their triangles' indices in the scene
    std::vector<std::uint32_t> caster_at_; ///< the reverse: by triangle of the scene
    std::vector<std::uint8_t> drawn_;      ///< which show a side that is not culled
    CasterGrid grid_;
    std::unique_ptr<Tracer> tracer_; ///< null without casters
    double half_step_ = 0;           ///< of the snapping grid, texels
    double reach_ = 0;               ///< how far aside a caster may be drawn, texels

    std::uint32_t caster_of(std::uint32_t triangle) const;
    AnyRay ray_from(const glm::dvec3& origin, const LiftedLimits& lifted) const;
    AnyRay ray_at(double x, double y, const LiftedLimits& lifted = {}) const;
    AnyRay ray_through(const glm::dvec3& from_light, const LiftedLimits& lifted) const;
    std::vector<FromLight>
    met(std::span<const AnyRay> rays, const LiftedLimits& lifted = {},
        const std::function<bool(const AnyRay&, std::uint32_t)>& stands = {}) const;
    MaskError mask_error(const Texel& texel, std::uint32_t caster) const;
    bool stands(const Texel& texel, const AnyRay& ray, std::uint32_t caster,
                MaskReading reading) const;
    bool may_stand(const Texel& texel, std::span<const AnyRay> rays, std::uint32_t caster) const;
    std::vector<FromLight> met_in_all_ways(const Texel& texel, std::span<const AnyRay> rays) const;
    double window(double depth) const { return map_window_depth(model(), depth); }
    Plane plane(const Texel& texel, std::uint32_t caster) const;
    PolygonOffset offset(const Texel& texel, std::uint32_t caster) const;
    double error(const Texel& texel, std::uint32_t caster, const Plane& plane) const;
    double least_error(const Plane& plane) const;
    bool may_store(const Texel& texel, std::uint32_t caster) const;
    bool may_draw(const Texel& texel, std::uint32_t caster) const;
    bool may_show(const Texel& texel, std::uint32_t triangle) const override;
    std::optional<std::uint32_t> shown_around(const Texel& texel) const override;
};

} // namespace shadowproof
