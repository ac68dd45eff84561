#include "raster/lighting.h"

#include "raster/lit_sides.h"
#include "scenes/error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <string>

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

std::vector<Texture> upload_textures(const GlFunctions& gl, const Scene& scene) {
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    std::vector<Texture> textures;
    for (const TextureImage& texture : scene.textures) {
        const Image<glm::vec4>& texels = texture.texels;
        if (texels.width > most || texels.height > most)
            throw Error(scene.file.string() + ": " + texture.name,
                        "the driver takes at most " + std::to_string(most) + " texels a side",
                        "make the image smaller");
        textures.push_back(upload_texels(gl, texels));
    }
    textures.push_back(upload_texels(gl, Image<glm::vec4>(1, 1, glm::vec4(1))));
    return textures;
}

void upload_corners(const GlFunctions& gl, const Scene& scene, LightingPass& pass) {
    std::vector<glm::vec3> positions;
    positions.reserve(scene.surfaces.size());
    for (const glm::uvec3& triangle : scene.triangles)
        for (int k = 0; k < 3; ++k) positions.push_back(scene.positions[triangle[k]]);
    pass.positions = make_filled_buffer(gl, std::array{std::as_bytes(std::span(positions))});
    pass.surfaces = make_filled_buffer(gl, std::array{std::as_bytes(std::span(scene.surfaces))});
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
}

/// Adds a triangle of a mesh to the last run, or to a new one where it is lit otherwise.
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

Program link_lighting(const GlFunctions& gl, const ClipTransform& transform, const glm::mat3& axes,
                      const ShaderText& fragment) {
    const std::array stages{shader_file("lit.vert"), fragment};
    Program program = link(gl, stages);
    set_transform(gl, program, transform);
    gl.ProgramUniformMatrix3fv(program.name(), 5, 1, GL_FALSE, glm::value_ptr(axes));
    return program;
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
    const double cosine = std::cos(light.outer_cone);
    const double scale = light.kind == Light::Kind::spot
                             ? 1 / std::max(0.001, std::cos(light.inner_cone) - cosine)
                             : 0;
    gl.ProgramUniform1f(program.name(), 18, static_cast<float>(cosine));
    gl.ProgramUniform1f(program.name(), 19, static_cast<float>(scale));
    const bool has_place = light.kind != Light::Kind::directional;
    gl.ProgramUniform1i(program.name(), 20, inverse_square && has_place ? 1 : 0);
}

void set_material(const GlFunctions& gl, const Program& program, const LightingPass& pass,
                  const Scene& scene, const Material& material) {
    set_color(gl, program, 6, material.color);
    set_color(gl, program, 7, material.specular);
    gl.ProgramUniform1i(program.name(), 8, material.gloss_in_alpha ? 1 : 0);
    gl.ProgramUniform1i(program.name(), 9, static_cast<GLint>(material.bump));
    gl.ProgramUniform1f(program.name(), 10, static_cast<float>(material.bump_scale));
    const auto bind = [&](GLuint unit, std::uint32_t texture, GLint wrap) {
        const bool white = texture == no_texture;
        const Texture& bound = white ? pass.textures.back() : pass.textures[texture];
        gl.BindTextureUnit(unit, bound.name());
        if (white) return;
        const TextureImage& image = scene.textures[texture];
        gl.ProgramUniform1i(program.name(), wrap, static_cast<GLint>(image.wrap_s));
        gl.ProgramUniform1i(program.name(), wrap + 1, static_cast<GLint>(image.wrap_t));
    };
    bind(1, material.decal, 12);
    bind(2, material.bump_map, 14);
}

} // namespace

LightingPass make_lighting_pass(const GlFunctions& gl, const Scene& scene,
                                const ClipTransform& transform, const LightingRecipe& recipe) {
    assert(is_bump_lit(scene));
    LightingPass pass;
    upload_corners(gl, scene, pass);
    make_runs(gl, scene, pass);
    pass.textures = upload_textures(gl, scene);
    check(gl, "uploading what lighting needs");
    const glm::dmat3 axes = recipe.axes == LightingRecipe::Axes::eye
                                ? view_from_eye_relative(scene.camera)
                                : glm::dmat3(1);
    pass.ambient = link_lighting(gl, transform, glm::mat3(axes), shader_file("ambient.frag"));
    set_color(gl, pass.ambient, 16, scene.ambient);
    pass.lit = link_lighting(gl, transform, glm::mat3(axes), recipe.lit);
    set_light(gl, pass.lit, scene, axes);
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

    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    gl.UseProgram(pass.ambient.name());
    for (const LitRun& run : pass.all_runs) {
        set_material(gl, pass.ambient, pass, scene, scene.materials[run.material]);
        gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * run.first),
                      static_cast<GLsizei>(3 * run.count));
    }
    gl.UseProgram(pass.lit.name());
    for (const LitRun& run : pass.lit_runs) {
        set_material(gl, pass.lit, pass, scene, scene.materials[run.material]);
        gl.StencilFunc(run.receives ? GL_EQUAL : GL_ALWAYS, 0, ~0U);
        gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * run.count), GL_UNSIGNED_INT,
                        reinterpret_cast<const void*>(std::size_t{3} * sizeof(GLuint) * run.first));
    }
    gl.Disable(GL_BLEND);
    check(gl, "the lighting pass");
}

} // namespace shadowproof
