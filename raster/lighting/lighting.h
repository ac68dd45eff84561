// Lighting by bump maps: the passes that light the visible surfaces, by one light or by several in
// turn. For bump-lit scenes (is_bump_lit).
#pragma once

#include "raster/gl/shader.h"
#include "raster/lighting/lit_scene.h"
#include "raster/passes/passes.h"
#include "scenes/lighting_settings.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace shadowproof {

/// One pass over the visible surfaces.
struct LightingStep {
    ShaderText fragment{};
    enum class Where : std::uint8_t {
        everywhere,
        lit, ///< on the lit sides, where the stencil is zero or no shadows are received
    };
    Where where = Where::everywhere;
    /// How the result is combined with the colour in the buffer.
    enum class Blend : std::uint8_t { overwrite, add, multiply };
    Blend blend = Blend::overwrite;
};

/// Everything in which ways of lighting differ.
struct LightingRecipe {
    std::vector<LightingStep> steps{};
    ColorModel model{}; ///< the colour buffer holds bytes unless its arithmetic is floating
};

/// Ambient light everywhere, by a shader of its own, and, added to it on lit pixels, the result of
/// another.
std::vector<LightingStep>
add_lit_to_ambient(const ShaderText& lit, const ShaderText& ambient = shader_file("ambient.frag"));

/// Ambient light times the decal everywhere and, over it on lit pixels, the result of a shader that
/// computes all of the lighting.
std::vector<LightingStep> replace_ambient_where_lit(const ShaderText& lit);

/// Kilgard's passes: ambient light, over it on lit pixels ambient and diffuse light, all of it
/// times the decal, and the highlight added on lit pixels.
std::vector<LightingStep> three_passes(const ShaderText& diffuse, const ShaderText& specular);

/// The result of such a shader, added everywhere. The recipe's model must have `reflects` set.
LightingStep add_reflection(const ShaderText& reflection);

/// A LightingStep, ready to be drawn.
struct LightingProgram {
    Program program{};
    LightingStep::Where where = LightingStep::Where::everywhere;
    LightingStep::Blend blend = LightingStep::Blend::overwrite;
};

/// Lighting by one light.
struct LightingPass {
    std::shared_ptr<const LitScene> lit{};
    VertexArray corners{};
    Triangles lit_sides{}; ///< indices into the corners
    std::vector<LitRun> lit_runs{};
    std::vector<LightingProgram> steps{};
};
/// The scene must have an environment where the recipe's model reflects. `before`: of another
/// light, drawn before it, to whose light its own is added, without ambient light; null where it is
/// the first. Throws Error where a texture is larger than the driver takes, and where a bump map
/// cannot be converted to the form of the recipe's model.
LightingPass make_lighting_pass(const GlFunctions& gl, const Scene& scene,
                                const ClipTransform& transform, const LightingRecipe& recipe,
                                Between between, const LightingPass* before);

/// Draws the colours (add_color) where the depth is equal, one step of the recipe after the other;
/// those that are drawn where it is lit under each light in turn, the chosen one last, and between
/// two others all together. `shadow`: makes a light's stencil, by its number, and depths to which
/// its pass is drawn; the first's must be there. Writes neither stencil nor depth itself; leaves a
/// vertex array of its own bound.
void draw_lighting(const GlFunctions& gl, std::span<const LightingPass> lights, const Scene& scene,
                   const Target& target, const std::function<void(std::size_t light)>& shadow);

} // namespace shadowproof
