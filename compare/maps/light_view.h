// The casters as the light sees them: what each texel of a shadow map ought to hold, traced as the
// ray from the light through the texel's centre, and within which bounds a driver may store it.
#pragma once

#include "scenes/scene.h"
#include "scenes/shadow_map.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
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

using FoundTriangle = std::function<void(std::size_t ray, std::uint32_t triangle)>;

/// A point, relative to the light, and the face that looks at it.
struct PointOnFace {
    std::size_t face = 0;
    glm::dvec3 from_light{0, 0, 0};
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
    /// Of so many texels of a row.
    std::span<const float> stored_row(const Texel& first, int count) const {
        const Image<float>& face = map_.faces[first.face];
        return std::span(face.pixels)
            .subspan(face.index(first.x, first.y), static_cast<std::size_t>(count));
    }

    /// The triangles that the rays through the texels' centres meet: found(index, triangle), on all
    /// threads. Many rays are quicker together than one by one, as they are in what follows.
    virtual void trace(std::span<const Texel> texels, const FoundTriangle& found) const = 0;
    /// The same without some of the camera's limits.
    virtual std::vector<FromLight> trace_without(const LiftedLimits& lifted,
                                                 std::span<const Texel> texels) const = 0;
    /// Of the rays through points.
    virtual std::vector<FromLight> trace_to(std::span<const PointOnFace> points,
                                            const LiftedLimits& lifted = {}) const = 0;

    /// The triangle whose surface the texel shows: the one at its centre, or another that the
    /// driver may draw there; no_triangle where it shows none. Nothing where no rasterizer would
    /// store what it holds.
    std::optional<std::uint32_t> shown(const Texel& texel, std::uint32_t at_centre) const;

    /// What a texel holds exactly that shows a triangle's surface at its centre.
    struct Shown {
        std::uint32_t triangle = no_triangle;
        double value = std::numeric_limits<double>::infinity(); ///< in world units, by the model's
                                                                ///< kind; infinity: nothing
        double moved = value; ///< the same as the polygon offset moves it
    };
    virtual Shown showing(const Texel& texel, std::uint32_t triangle) const = 0;

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
    /// Whether the texel may hold what is stored there because it shows this triangle.
    virtual bool may_show(const Texel& texel, std::uint32_t triangle) const = 0;
    /// Any triangle that the driver may draw there, as of shown.
    virtual std::optional<std::uint32_t> shown_around(const Texel& texel) const = 0;

    const MapEvidence& map_;
    bool has_format_;             ///< the map's is its model's
    double steps_;                ///< of a format of whole numbers; 0: of floats
    std::vector<Camera> cameras_; ///< one per face
};

/// The scene's casting triangles under its light, with their masks: as they are drawn, for the
/// order of a triangle's corners decides into which ones clipping divides it. `of_scene`: set to
/// their numbers in the scene.
Scene casters_alone(const Scene& scene, bool double_sided, std::vector<std::uint32_t>& of_scene);

/// By each triangle of a scene its place in a list of some of them; no_triangle of others.
std::vector<std::uint32_t> inverse_of(std::span<const std::uint32_t> of_scene,
                                      std::size_t triangles);

/// `subpixel_bits`: the driver's. A sun's view is parallel (parallel_view.h), others are in
/// perspective (perspective_view.h).
std::unique_ptr<LightView> light_view(const Scene& scene, const MapEvidence& map, int subpixel_bits,
                                      int threads);

} // namespace shadowproof
