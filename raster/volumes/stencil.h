// Stencil shadow volumes: the surface pass, the volume pass and the light pass, as configured by a
// recipe.
#pragma once

#include "raster/gl/context.h"
#include "raster/lighting/lighting.h"
#include "raster/volumes/volume_pass.h"
#include "scenes/frame.h"
#include "scenes/plan/plan.h"
#include "scenes/scene.h"

#include <optional>
#include <span>

namespace shadowproof {

/// Everything in which stencil techniques differ.
struct StencilRecipe {
    Counting counting;      ///< including near_plane's effect on `start`
    DepthModel depth_model; ///< subpixel_bits is taken from the driver
    /// One flag per triangle of the scene: those that Counting::flips flips here, see
    /// counted_casters.h. Empty: none is flipped.
    std::vector<std::uint8_t> flipped{};
    VolumeMaking making = VolumeMaking::on_cpu;
    std::function<Extruder(const Scene& casters)> extruder = by_silhouettes; ///< on the CPU
    VolumeFaces::Sides sides = VolumeFaces::Sides::surplus;                  ///< the extruder's
    /// One flag per triangle of the scene: its light cap is not drawn where faces in front of the
    /// surface are counted, as it is never in front of the visible surface. On the CPU only; empty:
    /// all are drawn.
    std::vector<std::uint8_t> hidden_caps{};
    NearPlane near_plane = NearPlane::lost;
    Counter counter = Counter::stencil; ///< a sum requires Counting::bits 24 and wrapping
    /// Colours in addition to the claim: only of bump-lit scenes, and with a stencil.
    std::optional<LightingRecipe> lighting{};
};

/// A light whose light a picture adds up before the scene's own.
struct StencilLight {
    const Scene& scene; ///< with it chosen
    StencilRecipe recipe;
};

/// Draws one pixel of the frame, so that the driver finishes deferred compilation. Then draws the
/// whole as often as the Gpu times frames, including the making of what depends on the light; the
/// quickest is the time. Reads back the pictures, and draws the volumes once more to show and to
/// measure them. `before`: only where the recipe lights bumps; all must make volumes alike, and be
/// drawn to the same depths. Throws Error where the driver fails.
Frame draw_stencil_shadows(Gpu& gpu, const Scene& scene, const StencilRecipe& recipe,
                           std::span<const StencilLight> before = {});

/// The numbers in which techniques tell depths apart: window depth of 24 bits, up to a far plane or
/// to infinity; or reversed, up to infinity, in floats. Parallel lines of sight have no infinite
/// projection: there the last one is finite, and clamped.
DepthModel finite_depths(const Scene& scene) noexcept;
DepthModel infinite_depths(const Scene& scene) noexcept;
DepthModel reversed_depths(const Scene& scene) noexcept;

/// The recipes that the techniques start from.
StencilRecipe zpass_recipe(const Scene& scene);
StencilRecipe zfail_recipe(const Plan& plan, const DepthModel& depth_model);
StencilRecipe zfail_reversed_recipe(const Scene& scene, const Plan& plan);

} // namespace shadowproof
