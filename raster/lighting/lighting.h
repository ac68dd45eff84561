// Lighting by bump maps: the resources it needs on the GPU, and the passes that light the visible
// surfaces. For bump-lit scenes (is_bump_lit).
#pragma once

#include "raster/gl/shader.h"
#include "raster/passes/passes.h"
#include "scenes/lighting_settings.h"
#include "scenes/surface/normalisation_cube.h"

#include <cstddef>
#include <cstdint>
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

/// Ambient light everywhere and, added to it on lit pixels, the result of a shader.
std::vector<LightingStep> add_lit_to_ambient(const ShaderText& lit);

/// Ambient light times the decal everywhere and, over it on lit pixels, the result of a shader that
/// computes all of the lighting.
std::vector<LightingStep> replace_ambient_where_lit(const ShaderText& lit);

/// Kilgard's passes: ambient light, over it on lit pixels ambient and diffuse light, all of it
/// times the decal, and the highlight added on lit pixels.
std::vector<LightingStep> three_passes(const ShaderText& diffuse, const ShaderText& specular);

/// The result of such a shader, added everywhere. The recipe's model must have `reflects` set.
LightingStep add_reflection(const ShaderText& reflection);

/// A run of triangles that are lit alike.
struct LitRun {
    std::uint32_t first = 0; ///< triangle of those drawn
    std::uint32_t count = 0;
    std::uint32_t material = 0; ///< index into Scene::materials
    bool receives = true;       ///< shows shadows
};

/// The bump map of a material, as shaders read it.
struct BumpMap {
    Texture texels{};
    BumpForm form = BumpForm::as_given; ///< as_given where there is no map
    float scale = 1;
    float slope_range = 0;
    float texel_side = 0;
};

/// A LightingStep, ready to be drawn.
struct LightingProgram {
    Program program{};
    LightingStep::Where where = LightingStep::Where::everywhere;
    LightingStep::Blend blend = LightingStep::Blend::overwrite;
};

struct LightingPass {
    Buffer positions{};   ///< three per triangle
    Buffer surfaces{};    ///< as Scene::surfaces
    Buffer texel_sides{}; ///< TexelSides per corner, where heights are in units of space
    VertexArray corners{};
    Triangles lit_sides{}; ///< indices into the corners
    std::vector<LitRun> all_runs{};
    std::vector<LitRun> lit_runs{};
    std::vector<Texture> decals{};       ///< by index into Scene::textures; empty for others
    std::vector<BumpMap> bumps{};        ///< shared by materials with equal bump maps
    std::vector<std::size_t> bumps_of{}; ///< index into `bumps`, per material
    Texture white{};                     ///< a single texel
    Texture unit_vectors{};              ///< the normalisation cube map
    Texture normal_table{};              ///< indexed_normal, 256 per row
    Texture environment{};               ///< where the recipe's model reflects
    std::vector<LightingProgram> steps{};
};
/// A GL_RGB8 array texture with one layer per face.
Texture upload_cube(const GlFunctions& gl, const NormalisationCube& cube);

/// The scene must have an environment where the recipe's model reflects. Throws Error where a
/// texture is larger than the driver takes, and where a bump map cannot be converted to the form of
/// the recipe's model.
LightingPass make_lighting_pass(const GlFunctions& gl, const Scene& scene,
                                const ClipTransform& transform, const LightingRecipe& recipe);

/// Draws the colours (add_color) where the depth is equal, one step of the recipe after the other.
/// Writes neither stencil nor depth; leaves its own vertex array bound.
void draw_lighting(const GlFunctions& gl, const LightingPass& pass, const Scene& scene,
                   const Target& target);

} // namespace shadowproof
