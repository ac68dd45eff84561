#include "raster/lighting/lit_scene.h"

#include "raster/passes/passes.h"
#include "scenes/error.h"
#include "scenes/surface/bump_forms.h"
#include "scenes/surface/bump_pyramid.h"
#include "scenes/surface/polygon_tangents.h"
#include "scenes/surface/texel_sides.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/vec2.hpp>
#include <span>
#include <string>

namespace shadowproof {

namespace {

/// All levels of a texture, of which the shaders fetch texels.
Texture upload_levels(const GlFunctions& gl, std::span<const Image<glm::vec4>> levels) {
    Texture texture = make_texture(gl, GL_TEXTURE_2D);
    gl.TextureStorage2D(texture.name(), static_cast<GLsizei>(levels.size()), GL_RGBA32F,
                        levels[0].width, levels[0].height);
    for (std::size_t level = 0; level < levels.size(); ++level)
        gl.TextureSubImage2D(texture.name(), static_cast<GLint>(level), 0, 0, levels[level].width,
                             levels[level].height, GL_RGBA, GL_FLOAT, levels[level].pixels.data());
    // Under the initial filter a texture without all its mipmaps is incomplete.
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER,
                         levels.size() > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

Texture upload_texels(const GlFunctions& gl, const Image<glm::vec4>& texels) {
    return upload_levels(gl, std::span(&texels, 1));
}

void require_size(const GlFunctions& gl, const Scene& scene, const std::string& name, int side) {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (side <= most) return;
    throw Error(scene.file.string() + ": " + name,
                "the driver takes at most " + std::to_string(most) + " texels a side",
                "make the image smaller");
}

void require_size(const GlFunctions& gl, const Scene& scene, const TextureImage& texture) {
    require_size(gl, scene, texture.name, std::max(texture.texels.width, texture.texels.height));
}

/// The format of a layer's texels in memory and in the texture.
struct LayerFormat {
    GLenum stored;
    GLenum channels;
    GLenum type;
};

/// A cube map as an array of its faces, of which the shaders fetch texels.
template <class Texel>
Texture upload_faces(const GlFunctions& gl, const CubeFaces<Texel>& faces,
                     const LayerFormat& format) {
    const int size = faces[0].width;
    Texture texture = make_texture(gl, GL_TEXTURE_2D_ARRAY);
    gl.TextureStorage3D(texture.name(), 1, format.stored, size, size,
                        static_cast<GLsizei>(faces.size()));
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (std::size_t face = 0; face < faces.size(); ++face)
        gl.TextureSubImage3D(texture.name(), 0, 0, 0, static_cast<GLint>(face), size, size, 1,
                             format.channels, format.type, faces[face].pixels.data());
    constexpr GLint initial_alignment = 4;
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, initial_alignment);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

Texture upload_environment(const GlFunctions& gl, const Scene& scene) {
    assert(scene.environment);
    const CubeFaces<glm::vec3>& faces = *scene.environment;
    require_size(gl, scene, "/extras/shadowproof/environment", faces[0].width);
    return upload_faces(gl, faces, {GL_RGB32F, GL_RGB, GL_FLOAT});
}

/// The form tells shaders only that there is a map.
BumpMap upload_pyramid(const GlFunctions& gl, const Scene& scene, const Material& material,
                       BumpFilter filter) {
    const BumpPyramid pyramid = bump_pyramid(scene, material, filter);
    BumpMap bumps{.texels = upload_levels(gl, pyramid.levels), .form = BumpForm::normal_map};
    if (!pyramid.cross.empty()) bumps.slope_products = upload_levels(gl, pyramid.cross);
    return bumps;
}

BumpMap upload_bumps(const GlFunctions& gl, const Scene& scene, const Material& material,
                     const ColorModel& model) {
    if (material.bump == Bump::none) return {};
    require_size(gl, scene, scene.textures[material.bump_map]);
    if (filters(model)) return upload_pyramid(gl, scene, material, model.filter);
    const BumpTexels bumps = bump_texels(scene, material, model.bump_form);
    return {.texels = upload_texels(gl, bumps.texels),
            .form = bumps.form,
            .scale = static_cast<float>(bumps.scale),
            .slope_range = static_cast<float>(bumps.slope_range),
            .texel_side = static_cast<float>(bumps.texel_side)};
}

Texture upload_normal_table(const GlFunctions& gl) {
    Image<glm::vec4> table(256, 256);
    for (std::size_t i = 0; i < table.pixels.size(); ++i)
        table.pixels[i] = glm::vec4(indexed_normal(static_cast<std::uint16_t>(i)), 0);
    return upload_texels(gl, table);
}

/// Whether two materials have equal bump maps.
bool have_same_bumps(const Material& a, const Material& b) {
    // Of heights in units of space the mean texel is a material's own.
    return a.bump == b.bump && a.bump_map == b.bump_map && a.bump_scale == b.bump_scale &&
           !a.height_in_space && !b.height_in_space;
}

/// Uploads the textures of the materials that are drawn: an unused one may have bumps that have no
/// such form.
void upload_textures(const GlFunctions& gl, const Scene& scene, const ColorModel& model,
                     LitScene& lit) {
    lit.decals.resize(scene.textures.size());
    lit.bumps_of.resize(scene.materials.size());
    std::vector<std::uint32_t> made_of; // the material that each of lit.bumps was made of
    for (const LitRun& run : lit.all_runs) {
        const Material& material = scene.materials[run.material];
        const auto same = std::ranges::find_if(made_of, [&](std::uint32_t other) {
            return other == run.material || have_same_bumps(material, scene.materials[other]);
        });
        lit.bumps_of[run.material] = static_cast<std::size_t>(same - made_of.begin());
        if (same == made_of.end()) {
            lit.bumps.push_back(upload_bumps(gl, scene, material, model));
            made_of.push_back(run.material);
        }
        if (material.decal == no_texture || lit.decals[material.decal].name() != 0) continue;
        const TextureImage& decal = scene.textures[material.decal];
        require_size(gl, scene, decal);
        lit.decals[material.decal] = filters(model) ? upload_levels(gl, mipmap_of(decal.texels))
                                                    : upload_texels(gl, decal.texels);
    }
    lit.white = upload_texels(gl, Image<glm::vec4>(1, 1, glm::vec4(1)));
    if (model.normalisation == Normalisation::cube_map)
        lit.unit_vectors = upload_cube(gl, make_normalisation_cube(model.cube_size));
    if (model.bump_form == BumpForm::indexed) lit.normal_table = upload_normal_table(gl);
}

Buffer upload_surfaces(const GlFunctions& gl, const Scene& scene, TangentSource tangents) {
    if (tangents == TangentSource::vertices)
        return make_filled_buffer(gl, std::array{std::as_bytes(std::span(scene.surfaces))});
    const std::vector<Surface> surfaces = surfaces_with_polygon_tangents(scene);
    return make_filled_buffer(gl, std::array{std::as_bytes(std::span(surfaces))});
}

Buffer upload_texel_sides(const GlFunctions& gl, const Scene& scene) {
    std::vector<std::array<glm::vec3, 2>> sides;
    sides.reserve(scene.surfaces.size());
    for (std::uint32_t triangle = 0; triangle < scene.triangles.size(); ++triangle) {
        const Mesh& mesh = scene.meshes[mesh_of(scene, triangle)];
        const TexelSides side = scene.materials[mesh.material].height_in_space
                                    ? texel_sides(scene, triangle)
                                    : TexelSides{};
        for (int k = 0; k < 3; ++k) sides.push_back({glm::vec3(side.along), glm::vec3(side.down)});
    }
    return make_filled_buffer(gl, std::array{std::as_bytes(std::span(sides))});
}

void upload_corners(const GlFunctions& gl, const Scene& scene, const ColorModel& model,
                    LitScene& lit) {
    std::vector<glm::vec3> positions;
    positions.reserve(scene.surfaces.size());
    for (const glm::uvec3& triangle : scene.triangles)
        for (int k = 0; k < 3; ++k) positions.push_back(scene.positions[triangle[k]]);
    lit.positions = make_filled_buffer(gl, std::array{std::as_bytes(std::span(positions))});
    lit.surfaces = upload_surfaces(gl, scene, model.tangents);
    // Tangent space does without.
    if (model.axes == ColorModel::Axes::eye && has_heights_in_space(scene))
        lit.texel_sides = upload_texel_sides(gl, scene);
}

} // namespace

Texture upload_cube(const GlFunctions& gl, const NormalisationCube& cube) {
    return upload_faces(gl, cube.faces, {GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE});
}

void extend(std::vector<LitRun>& runs, const Mesh& mesh, bool receives) {
    if (runs.empty() || runs.back().material != mesh.material || runs.back().receives != receives) {
        const std::uint32_t first = runs.empty() ? 0 : runs.back().first + runs.back().count;
        runs.push_back({first, 0, mesh.material, receives});
    }
    ++runs.back().count;
}

std::shared_ptr<const LitScene> make_lit_scene(const GlFunctions& gl, const Scene& scene,
                                               const ColorModel& model) {
    assert(is_bump_lit(scene));
    auto lit = std::make_shared<LitScene>();
    upload_corners(gl, scene, model, *lit);
    for (const Mesh& mesh : scene.meshes)
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) extend(lit->all_runs, mesh, true);
    upload_textures(gl, scene, model, *lit);
    if (model.reflects) lit->environment = upload_environment(gl, scene);
    check(gl, "uploading what lighting needs");
    return lit;
}

} // namespace shadowproof
