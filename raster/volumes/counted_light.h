// One light over a scene: its shadow volumes, made as a recipe says, and the passes that draw them.
#pragma once

#include "raster/gl/gl.h"
#include "raster/passes/passes.h"
#include "raster/volumes/stencil.h"
#include "raster/volumes/volume_pass.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace shadowproof {

class CountedLight {
public:
    /// Keeps references. The target must have what its counter needs.
    CountedLight(const GlFunctions& gl, const Scene& scene, const StencilRecipe& recipe,
                 const Target& target);
    ~CountedLight();
    CountedLight(const CountedLight&) = delete;
    CountedLight& operator=(const CountedLight&) = delete;

    const Scene& scene() const { return scene_; }
    const StencilRecipe& recipe() const { return recipe_; }
    const ClipTransform& transform() const { return transform_; }
    /// What its surfaces are drawn through.
    Between between() const;

    /// Makes what depends on where the light is.
    void update();
    /// Sets the state of a frame, for all passes of this light.
    void begin() const;
    /// Clears the target, and draws the surfaces.
    void draw_surfaces() const;
    /// Sets the stencil to what counting starts from, where the surfaces stay.
    void clear_stencil() const;
    /// Counts the volumes' faces.
    void count();
    /// Shows what is lit as such.
    void draw_lit() const;
    /// Draws the volumes once more, to show and to measure them.
    void measure(Frame& frame);

private:
    struct Part;

    const GlFunctions& gl_;
    const Scene& scene_;
    const StencilRecipe& recipe_;
    const Target& target_;
    std::vector<std::unique_ptr<Part>> parts_; // their passes refer to them
    Geometry geometry_;
    ClipTransform transform_;
    SurfacePrograms surface_;
    Program light_;
    std::optional<VolumePass> occluders_;
    std::int64_t start_ = 0;     ///< what the counter starts from
    bool touches_light_ = false; ///< some caster does

    static std::vector<std::unique_ptr<Part>> make_parts(const Scene& scene,
                                                         const StencilRecipe& recipe);
    static std::vector<glm::vec3> split_points(const Scene& scene, const StencilRecipe& recipe,
                                               std::vector<std::unique_ptr<Part>>& parts);
    bool has_caps_at_infinity() const;
    std::uint8_t stencil_start() const;
    VolumePass make_volumes(const Part& part) const;
    void count_in_stencil();
    void count_in_sum();
};

} // namespace shadowproof
