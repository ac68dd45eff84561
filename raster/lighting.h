// Lighting by bump maps: what it needs of a scene on the GPU, and the passes that light what is
// seen. For scenes that are bump-lit (is_bump_lit).
#pragma once

#include "raster/passes.h"
#include "raster/shader.h"
#include "scenes/lighting_settings.h"
#include "scenes/normalisation_cube.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowproof {

/// One pass over what is seen.
struct LightingStep {
    ShaderText fragment{};
    enum class Where : std::uint8_t {
        everywhere,
        lit, ///< on the lit sides, where the stencil is zero or no shadows are shown
    };
    Where where = Where::everywhere;
    /// What becomes of the colour that is there.
    enum class Blend : std::uint8_t { overwrite, add, multiply };
    Blend blend = Blend::overwrite;
};

/// All that tells one way of lighting from another.
struct LightingRecipe {
    std::vector<LightingStep> steps{};
    ColorModel model{}; ///< the colour buffer holds bytes unless all is floating
};

/// Ambient light everywhere, and added to it where it is lit what a shader says.
std::vector<LightingStep> add_lit_to_ambient(const ShaderText& lit);

/// What such a shader says, added everywhere. The recipe's model must reflect.
LightingStep add_reflection(const ShaderText& reflection);

/// A run of triangles that are lit alike.
struct LitRun {
    std::uint32_t first = 0; ///< triangle of what is drawn
    std::uint32_t count = 0;
    std::uint32_t material = 0; ///< index into Scene::materials
    bool receives = true;       ///< shows shadows
};

/// What the shaders read of a material's small normals.
struct BumpMap {
    Texture texels{};
    BumpForm form = BumpForm::as_given; ///< where there is no map
    float scale = 1;
    float slope_range = 0;
};

/// A LightingStep, ready to be drawn.
struct LightingProgram {
    Program program{};
    LightingStep::Where where = LightingStep::Where::everywhere;
    LightingStep::Blend blend = LightingStep::Blend::overwrite;
};

struct LightingPass {
    Buffer positions{}; ///< three a triangle
    Buffer surfaces{};  ///< Scene::surfaces as it is
    VertexArray corners{};
    Triangles lit_sides{}; ///< into the corners
    std::vector<LitRun> all_runs{};
    std::vector<LitRun> lit_runs{};
    std::vector<Texture> decals{};       ///< of each of Scene::textures that is one, as it is
    std::vector<BumpMap> bumps{};        ///< materials that read the same share it
    std::vector<std::size_t> bumps_of{}; ///< index into `bumps`, of each material
    Texture white{};                     ///< a single texel
    Texture unit_vectors{};              ///< the normalisation cube map
    Texture normal_table{};              ///< indexed_normal, 256 a row
    Texture environment{};               ///< where the recipe's model reflects
    std::vector<LightingProgram> steps{};
};
/// GL_RGB8, a layer a face.
Texture upload_cube(const GlFunctions& gl, const NormalisationCube& cube);

/// The transform must be relative to the eye, and the scene have an environment where the recipe's
/// model reflects. Throws Error where a texture is larger than the driver takes, and where a bump
/// map cannot be had in the form that the recipe's model says.
LightingPass make_lighting_pass(const GlFunctions& gl, const Scene& scene,
                                const ClipTransform& transform, const LightingRecipe& recipe);

/// Draws the colours (add_color), the recipe's steps one after the other, where the depth is equal.
/// Writes neither stencil nor depth; leaves its own vertex array bound.
void draw_lighting(const GlFunctions& gl, const LightingPass& pass, const Scene& scene,
                   const Target& target);

} // namespace shadowproof
