// The casters as the light sees them: what each texel of a shadow map ought to hold, traced as the
// ray from the light through the texel's centre, and within which bounds a driver may store it.
#pragma once

#include "compare/driver/plane_at_pixel.h"
#include "reference/trace/trace.h"
#include "scenes/scene.h"
#include "scenes/shadow_map.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace shadowproof {

/// A texel: its face, and its place in the face camera's picture.
struct Texel {
    std::uint32_t face = 0;
    int x = 0;
    int y = 0;
    friend auto operator<=>(const Texel&, const Texel&) = default;
};

/// What a ray from the light meets first, between the near and far planes of the light's camera.
struct FromLight {
    std::uint32_t triangle = no_triangle; ///< of the scene that is judged
    double depth = 0;                     ///< along the face's axis; infinity: nothing
};

/// Keeps a reference to the evidence.
class LightView {
public:
    /// `subpixel_bits`: the driver's.
    LightView(const Scene& scene, const MapEvidence& map, int subpixel_bits, int threads);

    const MapModel& model() const { return map_.model; }
    const Camera& camera(std::size_t face) const { return faces_[face].camera; }

    /// Of the texels' centres.
    std::vector<FromLight> trace(std::span<const Texel> texels) const;
    /// Of the ray through a point, given relative to the light, whose face is `face`.
    FromLight trace_to(std::size_t face, const glm::dvec3& from_light) const;

    float stored(const Texel& texel) const { return map_.faces[texel.face].at(texel.x, texel.y); }

    /// The triangle whose surface the texel shows: the one at its centre, or another that the
    /// driver may draw there. `shows` is false where no rasterizer would store this.
    struct Shown {
        bool shows = false;
        std::uint32_t triangle = no_triangle;
        double value = 0; ///< exact at the texel's centre, on the triangle's plane: as the model's
                          ///< value, in world units; infinity where nothing is shown
    };
    Shown shown(const Texel& texel, const FromLight& at_centre) const;

private:
    const MapEvidence& map_;
    DepthModel depth_model_;
    std::vector<Scene> faces_;            ///< one per face; casters alone
    std::vector<std::uint32_t> of_scene_; ///< their triangles' indices in the scene
    std::unique_ptr<Tracer> tracer_;      ///< of the first face's scene; null without casters

    PlaneAtPixel plane(const Texel& texel, std::uint32_t caster) const;
    double value(const PlaneAtPixel& plane) const;
    bool may_store(const Texel& texel, std::uint32_t caster) const;
    bool is_in_format(float stored) const;
    bool may_be_clipped(const Texel& texel, const SeenSurface& seen) const;
    bool clipping_may_draw(const Texel& texel, std::uint32_t caster, double reach) const;
    Shown shown_around(const Texel& texel) const;
    Shown showing(const Texel& texel, std::uint32_t caster) const;
};

} // namespace shadowproof
