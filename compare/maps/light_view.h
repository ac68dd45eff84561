// The casters as the light sees them: what each texel of a shadow map ought to hold, traced as the
// ray from the light through the texel's centre, and within which bounds a driver may store it.
#pragma once

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

/// Limits of the light's camera that a counterfactual lifts.
struct LiftedLimits {
    bool range = false;   ///< its near and far planes cut nothing off
    bool culling = false; ///< both sides of casters are drawn
};

/// Keeps a reference to the evidence.
class LightView {
public:
    LightView(const LightView&) = delete;
    LightView& operator=(const LightView&) = delete;
    virtual ~LightView() = default;

    const MapModel& model() const { return map_.model; }
    const Camera& camera(std::size_t face) const { return cameras_[face]; }
    /// What points are relative to that are said to be from the light: the eye of all cameras.
    const glm::dvec3& origin() const { return cameras_.front().eye; }
    const OffsetUnit& offset_unit() const { return map_.offset_unit; }
    float stored(const Texel& texel) const { return map_.faces[texel.face].at(texel.x, texel.y); }

    /// Of the texels' centres.
    virtual std::vector<FromLight> trace(std::span<const Texel> texels) const = 0;
    /// Of the ray through a point, given relative to the light, whose face is `face`.
    virtual FromLight trace_to(std::size_t face, const glm::dvec3& from_light) const = 0;
    /// The same without some of the camera's limits.
    virtual FromLight trace_without(const LiftedLimits& lifted, std::size_t face,
                                    const glm::dvec3& from_light) const = 0;

    /// The triangle whose surface the texel shows: the one at its centre, or another that the
    /// driver may draw there. `shows` is false where no rasterizer would store this.
    struct Shown {
        bool shows = false;
        std::uint32_t triangle = no_triangle;
        double value = 0; ///< exact at the texel's centre, on the triangle's plane: as the model's
                          ///< value, in world units; infinity where nothing is shown
        double moved = 0; ///< the same as the polygon offset moves it
    };
    Shown shown(const Texel& texel, const FromLight& at_centre) const;
    /// What the texel's centre would show without some of the camera's limits.
    virtual Shown shown_without(const LiftedLimits& lifted, const Texel& texel) const = 0;

    /// A depth of a triangle of the scene as the polygon offset moves it there, in world units, and
    /// at most to the far plane; the depth itself without one.
    virtual double moved_away(const Texel& texel, std::uint32_t triangle, double depth) const = 0;

protected:
    LightView(const Scene& scene, const MapEvidence& map);

    /// Whether the map has the format that its model says, and the value is one that this has.
    bool is_in_format(float stored) const;
    /// Half a step of the format; 0 of floats.
    double half_step() const;
    /// A depth with an offset of its window depth.
    double moved_by(double depth, double offset) const;

private:
    /// Where the texel may hold what is stored there because it shows this triangle.
    virtual Shown shown_of(const Texel& texel, std::uint32_t triangle) const = 0;
    /// The same for any triangle that the driver may draw there.
    virtual Shown shown_around(const Texel& texel) const = 0;

    const MapEvidence& map_;
    std::vector<Camera> cameras_; ///< one per face
};

/// By each triangle of a scene its place in a list of some of them; no_triangle of others.
std::vector<std::uint32_t> inverse_of(std::span<const std::uint32_t> of_scene,
                                      std::size_t triangles);

/// `subpixel_bits`: the driver's. A sun's view is parallel (parallel_view.h), others are in
/// perspective (perspective_view.h).
std::unique_ptr<LightView> light_view(const Scene& scene, const MapEvidence& map, int subpixel_bits,
                                      int threads);

} // namespace shadowproof
