#include "raster/lighting/lighting.h"

#include "raster/passes/lit_sides.h"
#include "scenes/error.h"
#include "scenes/spot_cone.h"
#include "scenes/surface/bump_forms.h"
#include "scenes/surface/polygon_tangents.h"
#include "scenes/surface/texel_sides.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <string_view>

namespace shadowproof {

namespace {

Texture upload_texels(const GlFunctions& gl, const Image<glm::vec4>& texels) {
    Texture texture = make_texture(gl, GL_TEXTURE_2D);
    gl.TextureStorage2D(texture.name(), 1, GL_RGBA32F, texels.width, texels.height);
    gl.TextureSubImage2D(texture.name(), 0, 0, 0, texels.width, texels.height, GL_RGBA, GL_FLOAT,
                         texels.pixels.data());
    // The shaders fetch texels; under the initial filter a texture without mipmaps is incomplete.
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
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

BumpMap upload_bumps(const GlFunctions& gl, const Scene& scene, const Material& material,
                     BumpForm form) {
    if (material.bump == Bump::none) return {};
    require_size(gl, scene, scene.textures[material.bump_map]);
    const BumpTexels bumps = bump_texels(scene, material, form);
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
                     LightingPass& pass) {
    pass.decals.resize(scene.textures.size());
    pass.bumps_of.resize(scene.materials.size());
    std::vector<std::uint32_t> made_of; // the material that each of pass.bumps was made of
    for (const LitRun& run : pass.all_runs) {
        const Material& material = scene.materials[run.material];
        const auto same = std::ranges::find_if(made_of, [&](std::uint32_t other) {
            return other == run.material || have_same_bumps(material, scene.materials[other]);
        });
        pass.bumps_of[run.material] = static_cast<std::size_t>(same - made_of.begin());
        if (same == made_of.end()) {
            pass.bumps.push_back(upload_bumps(gl, scene, material, model.bump_form));
            made_of.push_back(run.material);
        }
        if (material.decal == no_texture || pass.decals[material.decal].name() != 0) continue;
        const TextureImage& decal = scene.textures[material.decal];
        require_size(gl, scene, decal);
        pass.decals[material.decal] = upload_texels(gl, decal.texels);
    }
    pass.white = upload_texels(gl, Image<glm::vec4>(1, 1, glm::vec4(1)));
    if (model.normalisation == Normalisation::cube_map)
        pass.unit_vectors = upload_cube(gl, make_normalisation_cube(model.cube_size));
    if (model.bump_form == BumpForm::indexed) pass.normal_table = upload_normal_table(gl);
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
                    LightingPass& pass) {
    std::vector<glm::vec3> positions;
    positions.reserve(scene.surfaces.size());
    for (const glm::uvec3& triangle : scene.triangles)
        for (int k = 0; k < 3; ++k) positions.push_back(scene.positions[triangle[k]]);
    pass.positions = make_filled_buffer(gl, std::array{std::as_bytes(std::span(positions))});
    pass.surfaces = upload_surfaces(gl, scene, model.tangents);
    pass.corners = make_vertex_array(gl);
    const GLuint corners = pass.corners.name();
    gl.VertexArrayVertexBuffer(corners, 0, pass.positions.name(), 0, sizeof(glm::vec3));
    gl.VertexArrayVertexBuffer(corners, 1, pass.surfaces.name(), 0, sizeof(Surface));
    // Locations as lit.vert lays them out.
    const auto attribute = [&](GLuint location, GLuint buffer, GLint numbers, std::size_t offset) {
        gl.VertexArrayAttribFormat(corners, location, numbers, GL_FLOAT, GL_FALSE,
                                   static_cast<GLuint>(offset));
        gl.VertexArrayAttribBinding(corners, location, buffer);
        gl.EnableVertexArrayAttrib(corners, location);
    };
    attribute(0, 0, 3, 0);
    attribute(1, 1, 3, offsetof(Surface, normal));
    attribute(2, 1, 4, offsetof(Surface, tangent));
    attribute(3, 1, 2, offsetof(Surface, decal_at));
    attribute(4, 1, 2, offsetof(Surface, bump_at));
    // Tangent space does without.
    if (model.axes != ColorModel::Axes::eye || !has_heights_in_space(scene)) return;
    pass.texel_sides = upload_texel_sides(gl, scene);
    gl.VertexArrayVertexBuffer(corners, 2, pass.texel_sides.name(), 0, 2 * sizeof(glm::vec3));
    attribute(5, 2, 3, 0);
    attribute(6, 2, 3, sizeof(glm::vec3));
}

/// Adds a triangle of a mesh to the last run, or to a new one where it is lit differently.
void extend(std::vector<LitRun>& runs, const Mesh& mesh, bool receives) {
    if (runs.empty() || runs.back().material != mesh.material || runs.back().receives != receives) {
        const std::uint32_t first = runs.empty() ? 0 : runs.back().first + runs.back().count;
        runs.push_back({first, 0, mesh.material, receives});
    }
    ++runs.back().count;
}

void make_runs(const GlFunctions& gl, const Scene& scene, LightingPass& pass) {
    for (const Mesh& mesh : scene.meshes)
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) extend(pass.all_runs, mesh, true);
    const LitSides sides = lit_sides(scene);
    std::vector<glm::uvec3> triangles;
    for (const std::uint32_t triangle : sides.triangles) {
        const bool receives = triangles.size() < sides.receivers;
        extend(pass.lit_runs, scene.meshes[mesh_of(scene, triangle)], receives);
        triangles.push_back(3 * triangle + glm::uvec3(0, 1, 2));
    }
    pass.lit_sides = upload_triangles(gl, std::array{std::span<const glm::uvec3>(triangles)});
    gl.VertexArrayElementBuffer(pass.corners.name(), pass.lit_sides.buffer.name());
}

void set_color(const GlFunctions& gl, const Program& program, GLint location,
               const glm::dvec3& color) {
    const glm::vec3 rounded(color);
    gl.ProgramUniform3fv(program.name(), location, 1, glm::value_ptr(rounded));
}

/// Locations here and below as lighting.glsl lays them out.
void set_light(const GlFunctions& gl, const Program& program, const Scene& scene,
               const glm::dmat3& axes) {
    const Light& light = chosen_light(scene);
    const bool inverse_square = scene.inverse_square;
    set_color(gl, program, 16, inverse_square ? light.color * light.intensity : light.color);
    set_color(gl, program, 17, axes * light.direction);
    const SpotCone cone = light.kind == Light::Kind::spot ? spot_cone(light) : SpotCone{};
    gl.ProgramUniform1f(program.name(), 18, static_cast<float>(cone.cos_outer));
    gl.ProgramUniform1f(program.name(), 19, static_cast<float>(cone.scale));
    const bool has_place = light.kind != Light::Kind::directional;
    gl.ProgramUniform1i(program.name(), 20, inverse_square && has_place ? 1 : 0);
    gl.ProgramUniform1i(program.name(), 25, by_light(scene.highlight.shadow) ? 1 : 0);
    gl.ProgramUniform1i(program.name(), 26, by_half_angle(scene.highlight.shadow) ? 1 : 0);
    gl.ProgramUniform1i(program.name(), 27, scene.highlight.squarings);
}

void set_material(const GlFunctions& gl, const Program& program, const LightingPass& pass,
                  const Scene& scene, std::uint32_t index) {
    const Material& material = scene.materials[index];
    const BumpMap& bumps = pass.bumps[pass.bumps_of[index]];
    set_color(gl, program, 6, material.color);
    set_color(gl, program, 7, material.specular);
    set_color(gl, program, 24, material.reflectance);
    gl.ProgramUniform1i(program.name(), 8, material.gloss_in_alpha ? 1 : 0);
    gl.ProgramUniform1i(program.name(), 9, static_cast<GLint>(bumps.form));
    gl.ProgramUniform1f(program.name(), 10, bumps.scale);
    gl.ProgramUniform1f(program.name(), 22, bumps.slope_range);
    gl.ProgramUniform1f(program.name(), 30, bumps.texel_side);
    const auto bind = [&](GLuint unit, std::uint32_t texture, const Texture& texels, GLint wrap) {
        gl.BindTextureUnit(unit, texels.name());
        if (texture == no_texture) return;
        const TextureImage& image = scene.textures[texture];
        gl.ProgramUniform1i(program.name(), wrap, static_cast<GLint>(image.wrap_s));
        gl.ProgramUniform1i(program.name(), wrap + 1, static_cast<GLint>(image.wrap_t));
    };
    bind(1, material.decal, material.decal == no_texture ? pass.white : pass.decals[material.decal],
         12);
    bind(2, material.bump_map, material.bump_map == no_texture ? pass.white : bumps.texels, 14);
}

/// A shader, preceded by constants for what is the same in all draws: llvmpipe runs both sides of a
/// branch, whichever is taken.
std::string with_constants(const ShaderText& shader, const LightingPass& pass,
                           const ColorModel& model) {
    constexpr std::string_view version = "#version 450 core\n";
    assert(shader.text.starts_with(version));
    unsigned forms = 0;
    for (const BumpMap& bumps : pass.bumps) forms |= 1U << static_cast<unsigned>(bumps.form);
    const bool in_space =
        std::ranges::any_of(pass.bumps, [](const BumpMap& bumps) { return bumps.texel_side > 0; });
    return std::string(version) +
           "const int normalisation = " + std::to_string(static_cast<int>(model.normalisation)) +
           ";\nconst int newton_steps = " + std::to_string(model.newton_steps) +
           ";\nconst int forms_in_use = " + std::to_string(forms) +
           ";\nconst bool heights_in_space = " + (in_space ? "true" : "false") +
           ";\nconst int vectors = " + std::to_string(static_cast<int>(model.vectors)) +
           ";\n#line 2\n" + std::string(shader.text.substr(version.size()));
}

LightingProgram make_step(const GlFunctions& gl, const Scene& scene, const ClipTransform& transform,
                          const LightingRecipe& recipe, const LightingPass& pass,
                          const LightingStep& step) {
    const glm::dmat3 axes = recipe.model.axes == ColorModel::Axes::eye
                                ? view_from_eye_relative(scene.camera)
                                : glm::dmat3(1);
    const ShaderText corners = shader_file("lit.vert");
    const std::string vertex = with_constants(corners, pass, recipe.model);
    const std::string fragment = with_constants(step.fragment, pass, recipe.model);
    const std::array stages{ShaderText{corners.file, vertex},
                            ShaderText{step.fragment.file, fragment}};
    LightingProgram made{link(gl, stages), step.where, step.blend};
    set_transform(gl, made.program, transform);
    const TwoFloats eye = split(scene.camera.eye);
    gl.ProgramUniform3fv(made.program.name(), 28, 1, glm::value_ptr(eye.high));
    gl.ProgramUniform3fv(made.program.name(), 29, 1, glm::value_ptr(eye.low));
    const glm::mat3 rounded(axes);
    gl.ProgramUniformMatrix3fv(made.program.name(), 5, 1, GL_FALSE, glm::value_ptr(rounded));
    set_light(gl, made.program, scene, axes);
    set_color(gl, made.program, 23, scene.ambient);
    return made;
}

void set_blend(const GlFunctions& gl, LightingStep::Blend blend) {
    set_enabled(gl, GL_BLEND, blend != LightingStep::Blend::overwrite);
    if (blend == LightingStep::Blend::add) gl.BlendFunc(GL_ONE, GL_ONE);
    if (blend == LightingStep::Blend::multiply) gl.BlendFunc(GL_DST_COLOR, GL_ZERO);
}

void draw_everywhere(const GlFunctions& gl, const LightingPass& pass, const Scene& scene,
                     const Program& program) {
    gl.StencilFunc(GL_ALWAYS, 0, ~0U);
    for (const LitRun& run : pass.all_runs) {
        set_material(gl, program, pass, scene, run.material);
        gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * run.first),
                      static_cast<GLsizei>(3 * run.count));
    }
}

void draw_where_lit(const GlFunctions& gl, const LightingPass& pass, const Scene& scene,
                    const Program& program) {
    for (const LitRun& run : pass.lit_runs) {
        set_material(gl, program, pass, scene, run.material);
        gl.StencilFunc(run.receives ? GL_EQUAL : GL_ALWAYS, 0, ~0U);
        gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * run.count), GL_UNSIGNED_INT,
                        reinterpret_cast<const void*>(std::size_t{3} * sizeof(GLuint) * run.first));
    }
}

} // namespace

std::vector<LightingStep> add_lit_to_ambient(const ShaderText& lit) {
    return {
        {.fragment = shader_file("ambient.frag")},
        {.fragment = lit, .where = LightingStep::Where::lit, .blend = LightingStep::Blend::add}};
}

std::vector<LightingStep> replace_ambient_where_lit(const ShaderText& lit) {
    return {{.fragment = shader_file("ambient.frag")},
            {.fragment = lit, .where = LightingStep::Where::lit}};
}

std::vector<LightingStep> three_passes(const ShaderText& diffuse, const ShaderText& specular) {
    using Step = LightingStep;
    return {{.fragment = shader_file("ambient_alone.frag")},
            {.fragment = diffuse, .where = Step::Where::lit},
            {.fragment = shader_file("decal.frag"), .blend = Step::Blend::multiply},
            {.fragment = specular, .where = Step::Where::lit, .blend = Step::Blend::add}};
}

LightingStep add_reflection(const ShaderText& reflection) {
    return {.fragment = reflection,
            .where = LightingStep::Where::everywhere,
            .blend = LightingStep::Blend::add};
}

Texture upload_cube(const GlFunctions& gl, const NormalisationCube& cube) {
    return upload_faces(gl, cube.faces, {GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE});
}

LightingPass make_lighting_pass(const GlFunctions& gl, const Scene& scene,
                                const ClipTransform& transform, const LightingRecipe& recipe) {
    assert(is_bump_lit(scene));
    LightingPass pass;
    upload_corners(gl, scene, recipe.model, pass);
    make_runs(gl, scene, pass);
    upload_textures(gl, scene, recipe.model, pass);
    if (recipe.model.reflects) pass.environment = upload_environment(gl, scene);
    check(gl, "uploading what lighting needs");
    for (const LightingStep& step : recipe.steps)
        pass.steps.push_back(make_step(gl, scene, transform, recipe, pass, step));
    check(gl, "making the lighting pass");
    return pass;
}

void draw_lighting(const GlFunctions& gl, const LightingPass& pass, const Scene& scene,
                   const Target& target) {
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(GL_EQUAL);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilMask(0);
    gl.StencilFunc(GL_ALWAYS, 0, ~0U);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl.Disable(GL_CULL_FACE); // a side that is culled in the surface pass is not the one seen
    constexpr std::array<GLfloat, 4> black{0, 0, 0, 0};
    gl.ClearNamedFramebufferfv(target.lighting.name(), GL_COLOR, 0, black.data());
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.lighting.name());
    gl.BindVertexArray(pass.corners.name());
    gl.BindTextureUnit(0, target.triangle.name());
    gl.BindTextureUnit(3, pass.unit_vectors.name());
    gl.BindTextureUnit(4, pass.normal_table.name());
    gl.BindTextureUnit(5, pass.environment.name());
    gl.Disable(GL_DITHER);
    gl.Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);

    for (const LightingProgram& step : pass.steps) {
        gl.UseProgram(step.program.name());
        set_blend(gl, step.blend);
        if (step.where == LightingStep::Where::everywhere)
            draw_everywhere(gl, pass, scene, step.program);
        else
            draw_where_lit(gl, pass, scene, step.program);
    }
    gl.Disable(GL_BLEND);
    check(gl, "the lighting pass");
}

} // namespace shadowproof
