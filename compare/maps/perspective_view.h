// The casters as a light with a position sees them, which draws its map in perspective.
#pragma once

#include "compare/driver/plane_at_pixel.h"
#include "compare/maps/caster_grid.h"
#include "compare/maps/light_view.h"
#include "compare/maps/polygon_offset.h"
#include "reference/trace/trace.h"

#include <array>
#include <mutex>

namespace shadowproof {

class PerspectiveView final : public LightView {
public:
    PerspectiveView(const Scene& scene, const MapEvidence& map, int subpixel_bits, int threads);

    void trace(std::span<const Texel> texels, const FoundTriangle& found) const override;
    std::vector<FromLight> trace_without(const LiftedLimits& lifted,
                                         std::span<const Texel> texels) const override;
    std::vector<FromLight> trace_to(std::span<const PointOnFace> points,
                                    const LiftedLimits& lifted) const override;
    Shown showing(const Texel& texel, std::uint32_t triangle) const override;
    double moved_away(const Texel& texel, std::uint32_t triangle, double depth) const override;

private:
    DepthModel depth_model_;
    std::vector<Scene> faces_;             ///< one per face; casters alone
    std::vector<std::uint32_t> of_scene_;  ///< their triangles' indices in the scene
    std::vector<std::uint32_t> caster_at_; ///< the reverse: by triangle of the scene
    std::vector<DepthPicture> pictures_;   ///< one per face
    /// The directions through texels' centres are the sum of a column's and a row's.
    std::vector<std::vector<glm::dvec3>> columns_;
    std::vector<std::vector<glm::dvec3>> rows_;
    std::vector<SeenPlane> planes_;           ///< theirs, before the eye that all faces share
    Scene seen_;                              ///< the first face's, whose culled sides are backs
    std::unique_ptr<Tracer> tracer_;          ///< of that; null without casters
    mutable std::array<CasterGrid, 6> grids_; ///< one per face, made when one is asked for
    mutable std::array<std::once_flag, 6> is_made_;

    std::vector<std::size_t> without_rays(std::span<const Texel> texels,
                                          const FoundTriangle& found) const;
    std::vector<FromLight> met(std::span<const glm::dvec3> rays, const LiftedLimits& lifted) const;
    glm::dvec3 direction(const Texel& texel) const {
        return columns_[texel.face][static_cast<std::size_t>(texel.x)] +
               rows_[texel.face][static_cast<std::size_t>(texel.y)];
    }
    PlaneAtPixel plane(const Texel& texel, std::uint32_t caster) const;
    double value(const PlaneAtPixel& plane) const;
    std::uint32_t caster_of(std::uint32_t triangle) const;
    PolygonOffset offset(const Texel& texel, std::uint32_t caster) const;
    double deepest(const Texel& texel, std::uint32_t caster) const;
    bool may_store_moved(const PlaneAtPixel& at, const Texel& texel, std::uint32_t caster) const;
    bool may_store_step(const PlaneAtPixel& at, const Texel& texel, std::uint32_t caster) const;
    bool may_store(const PlaneAtPixel& at, const Texel& texel, std::uint32_t caster) const;
    std::vector<PicturePoint> pictured(std::size_t face, std::uint32_t caster) const;
    const CasterGrid& grid(std::size_t face) const;
    bool may_be_clipped(const Texel& texel, const SeenSurface& seen) const;
    bool clipping_may_draw(const Texel& texel, std::uint32_t caster, double reach) const;
    bool may_show(const Texel& texel, std::uint32_t triangle) const override;
    std::optional<std::uint32_t> shown_around(const Texel& texel) const override;
};

} // namespace shadowproof
