// A bump-lit scene on the GPU: what lighting needs of it whatever its light.
#pragma once

#include "raster/gl/gl.h"
#include "scenes/lighting_settings.h"
#include "scenes/scene.h"
#include "scenes/surface/normalisation_cube.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace shadowproof {

/// A run of triangles that are lit alike.
struct LitRun {
    std::uint32_t first = 0; ///< triangle of those drawn
    std::uint32_t count = 0;
    std::uint32_t material = 0; ///< index into Scene::materials
    bool receives = true;       ///< shows shadows
};

/// The bump map of a material, as shaders read it: in one of its forms, or filtered.
struct BumpMap {
    Texture texels{};
    Texture slope_products{};           ///< BumpPyramid::cross
    BumpForm form = BumpForm::as_given; ///< as_given where there is no map
    float scale = 1;
    float slope_range = 0;
    float texel_side = 0;
};

struct LitScene {
    Buffer positions{};   ///< three per triangle
    Buffer surfaces{};    ///< as Scene::surfaces
    Buffer texel_sides{}; ///< TexelSides per corner, where heights are in units of space
    std::vector<LitRun> all_runs{};
    std::vector<Texture> decals{};       ///< by index into Scene::textures; empty for others;
                                         ///< mipmapped where the recipe's model filters
    std::vector<BumpMap> bumps{};        ///< shared by materials with equal bump maps
    std::vector<std::size_t> bumps_of{}; ///< index into `bumps`, per material
    Texture white{};                     ///< a single texel
    Texture unit_vectors{};              ///< the normalisation cube map
    Texture normal_table{};              ///< indexed_normal, 256 per row
    Texture environment{};               ///< where the recipe's model reflects
};

/// The scene must have an environment where the model reflects. Throws Error as make_lighting_pass.
std::shared_ptr<const LitScene> make_lit_scene(const GlFunctions& gl, const Scene& scene,
                                               const ColorModel& model);

/// Adds a triangle of a mesh to the last run, or to a new one where it is lit differently.
void extend(std::vector<LitRun>& runs, const Mesh& mesh, bool receives);

/// A GL_RGB8 array texture with one layer per face.
Texture upload_cube(const GlFunctions& gl, const NormalisationCube& cube);

} // namespace shadowproof
