// Lighting by bump maps: what it needs of a scene on the GPU, and the passes that light what is
// seen. For scenes that are bump-lit (is_bump_lit).
#pragma once

#include "raster/passes.h"
#include "raster/shader.h"

#include <cstdint>
#include <vector>

namespace shadowproof {

/// All that tells one way of lighting from another.
struct LightingRecipe {
    /// The axes that normals, tangents and the vectors to light and eye are handed over in.
    enum class Axes : std::uint8_t { world, eye };
    Axes axes = Axes::world;
    ShaderText lit; ///< the fragment shader of what depends on the light
};

/// A run of triangles that are lit alike.
struct LitRun {
    std::uint32_t first = 0; ///< triangle of what is drawn
    std::uint32_t count = 0;
    std::uint32_t material = 0; ///< index into Scene::materials
    bool receives = true;       ///< shows shadows
};

struct LightingPass {
    Buffer positions{}; ///< three a triangle
    Buffer surfaces{};  ///< Scene::surfaces as it is
    VertexArray corners{};
    Triangles lit_sides{}; ///< into the corners
    std::vector<LitRun> all_runs{};
    std::vector<LitRun> lit_runs{};
    std::vector<Texture> textures{}; ///< Scene::textures as they are; the last one is white
    Program ambient{};
    Program lit{};
};
/// The transform must be relative to the eye. Throws Error where a texture is larger than the
/// driver takes.
LightingPass make_lighting_pass(const GlFunctions& gl, const Scene& scene,
                                const ClipTransform& transform, const LightingRecipe& recipe);

/// Draws the colours (add_color) where the depth is equal: ambient light on all that is seen, and
/// added to it by blending, where the stencil is zero or no shadows are shown, what depends on the
/// light on the lit sides. Writes neither stencil nor depth; leaves its own vertex array bound.
void draw_lighting(const GlFunctions& gl, const LightingPass& pass, const Scene& scene,
                   const Target& target);

} // namespace shadowproof
