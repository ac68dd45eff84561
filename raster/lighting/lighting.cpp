#include "raster/lighting/lighting.h"

#include "raster/passes/lit_sides.h"
#include "scenes/spot_cone.h"

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

VertexArray make_corners(const GlFunctions& gl, const LitScene& lit) {
    VertexArray made = make_vertex_array(gl);
    const GLuint corners = made.name();
    gl.VertexArrayVertexBuffer(corners, 0, lit.positions.name(), 0, sizeof(glm::vec3));
    gl.VertexArrayVertexBuffer(corners, 1, lit.surfaces.name(), 0, sizeof(Surface));
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
    if (lit.texel_sides.name() == 0) return made;
    gl.VertexArrayVertexBuffer(corners, 2, lit.texel_sides.name(), 0, 2 * sizeof(glm::vec3));
    attribute(5, 2, 3, 0);
    attribute(6, 2, 3, sizeof(glm::vec3));
    return made;
}

void make_lit_runs(const GlFunctions& gl, const Scene& scene, LightingPass& pass) {
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

void set_material(const GlFunctions& gl, const Program& program, const LitScene& lit,
                  const Scene& scene, std::uint32_t index) {
    const Material& material = scene.materials[index];
    const BumpMap& bumps = lit.bumps[lit.bumps_of[index]];
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
    bind(1, material.decal, material.decal == no_texture ? lit.white : lit.decals[material.decal],
         12);
    bind(2, material.bump_map, material.bump_map == no_texture ? lit.white : bumps.texels, 14);
    gl.BindTextureUnit(7, bumps.slope_products.name());
}

/// A shader, preceded by constants for what is the same in all draws: llvmpipe runs both sides of a
/// branch, whichever is taken.
std::string with_constants(const ShaderText& shader, const LitScene& lit, const ColorModel& model) {
    constexpr std::string_view version = "#version 450 core\n";
    assert(shader.text.starts_with(version));
    unsigned forms = 0;
    for (const BumpMap& bumps : lit.bumps) forms |= 1U << static_cast<unsigned>(bumps.form);
    const bool in_space =
        std::ranges::any_of(lit.bumps, [](const BumpMap& bumps) { return bumps.texel_side > 0; });
    return std::string(version) +
           "const int normalisation = " + std::to_string(static_cast<int>(model.normalisation)) +
           ";\nconst int newton_steps = " + std::to_string(model.newton_steps) +
           ";\nconst int forms_in_use = " + std::to_string(forms) +
           ";\nconst bool heights_in_space = " + (in_space ? "true" : "false") +
           ";\nconst int vectors = " + std::to_string(static_cast<int>(model.vectors)) +
           ";\nconst int bump_filter = " + std::to_string(static_cast<int>(model.filter)) +
           ";\nconst int anisotropy = " + std::to_string(model.anisotropy) + ";\n#line 2\n" +
           std::string(shader.text.substr(version.size()));
}

/// A light's pass, as the programs of its steps are made for it.
struct PassPlace {
    const Scene& scene;
    const ClipTransform& transform;
    const LitScene& lit;
    Between between = Between::nothing;
    bool is_added = false; ///< to another light's
};

LightingProgram make_step(const GlFunctions& gl, const PassPlace& place, const ColorModel& model,
                          const LightingStep& step) {
    const Scene& scene = place.scene;
    const bool is_added = place.is_added && step.where == LightingStep::Where::lit;
    const glm::dmat3 axes =
        model.axes == ColorModel::Axes::eye ? view_from_eye_relative(scene.camera) : glm::dmat3(1);
    const ShaderText corners = shader_file("lit.vert");
    const std::string vertex = with_constants(corners, place.lit, model);
    const std::string fragment = with_constants(step.fragment, place.lit, model);
    std::vector<ShaderText> stages{{corners.file, vertex}, {step.fragment.file, fragment}};
    if (place.between == Between::geometry_shader) stages.push_back(shader_file("lit.geom"));
    LightingProgram made{link(gl, stages), step.where,
                         is_added ? LightingStep::Blend::add : step.blend};
    set_transform(gl, made.program, place.transform);
    const glm::dvec4 to_eye = homogeneous_eye(scene.camera);
    const TwoFloats eye = split(to_eye);
    gl.ProgramUniform3fv(made.program.name(), 28, 1, glm::value_ptr(eye.high));
    gl.ProgramUniform3fv(made.program.name(), 29, 1, glm::value_ptr(eye.low));
    gl.ProgramUniform1f(made.program.name(), 36, static_cast<float>(to_eye.w));
    const glm::mat3 rounded(axes);
    gl.ProgramUniformMatrix3fv(made.program.name(), 5, 1, GL_FALSE, glm::value_ptr(rounded));
    set_light(gl, made.program, scene, axes);
    set_color(gl, made.program, 23, is_added ? glm::dvec3(0) : scene.ambient);
    return made;
}

void set_blend(const GlFunctions& gl, LightingStep::Blend blend) {
    set_enabled(gl, GL_BLEND, blend != LightingStep::Blend::overwrite);
    if (blend == LightingStep::Blend::add) gl.BlendFunc(GL_ONE, GL_ONE);
    if (blend == LightingStep::Blend::multiply) gl.BlendFunc(GL_DST_COLOR, GL_ZERO);
}

void draw_everywhere(const GlFunctions& gl, const LitScene& lit, const Scene& scene,
                     const Program& program) {
    gl.StencilFunc(GL_ALWAYS, 0, ~0U);
    for (const LitRun& run : lit.all_runs) {
        set_material(gl, program, lit, scene, run.material);
        gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * run.first),
                      static_cast<GLsizei>(3 * run.count));
    }
}

void draw_where_lit(const GlFunctions& gl, const LightingPass& pass, const Scene& scene,
                    const Program& program) {
    for (const LitRun& run : pass.lit_runs) {
        set_material(gl, program, *pass.lit, scene, run.material);
        gl.StencilFunc(run.receives ? GL_EQUAL : GL_ALWAYS, 0, ~0U);
        gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * run.count), GL_UNSIGNED_INT,
                        reinterpret_cast<const void*>(std::size_t{3} * sizeof(GLuint) * run.first));
    }
}

void draw_step(const GlFunctions& gl, const LightingPass& pass, const LightingProgram& step,
               const Scene& scene) {
    gl.UseProgram(step.program.name());
    set_blend(gl, step.blend);
    if (step.where == LightingStep::Where::everywhere)
        draw_everywhere(gl, *pass.lit, scene, step.program);
    else
        draw_where_lit(gl, pass, scene, step.program);
}

/// The state in which all steps are drawn, after whatever was drawn last.
void begin_lighting(const GlFunctions& gl, const LightingPass& pass, const Target& target) {
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(GL_EQUAL);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilMask(0);
    gl.StencilFunc(GL_ALWAYS, 0, ~0U);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl.Disable(GL_CULL_FACE); // a side that is culled in the surface pass is not the one seen
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.lighting.name());
    gl.BindVertexArray(pass.corners.name());
    gl.BindTextureUnit(0, target.triangle.name());
    gl.BindTextureUnit(3, pass.lit->unit_vectors.name());
    gl.BindTextureUnit(4, pass.lit->normal_table.name());
    gl.BindTextureUnit(5, pass.lit->environment.name());
    gl.Disable(GL_DITHER);
    gl.Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

} // namespace

std::vector<LightingStep> add_lit_to_ambient(const ShaderText& lit, const ShaderText& ambient) {
    return {
        {.fragment = ambient},
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

LightingPass make_lighting_pass(const GlFunctions& gl, const Scene& scene,
                                const ClipTransform& transform, const LightingRecipe& recipe,
                                Between between, const LightingPass* before) {
    LightingPass pass;
    pass.lit = before != nullptr ? before->lit : make_lit_scene(gl, scene, recipe.model);
    pass.corners = make_corners(gl, *pass.lit);
    make_lit_runs(gl, scene, pass);
    const PassPlace place{scene, transform, *pass.lit, between, before != nullptr};
    for (const LightingStep& step : recipe.steps)
        pass.steps.push_back(make_step(gl, place, recipe.model, step));
    check(gl, "making the lighting pass");
    return pass;
}

void draw_lighting(const GlFunctions& gl, std::span<const LightingPass> lights, const Scene& scene,
                   const Target& target, const std::function<void(std::size_t light)>& shadow) {
    constexpr std::array<GLfloat, 4> black{0, 0, 0, 0};
    begin_lighting(gl, lights.front(), target);
    gl.ClearNamedFramebufferfv(target.lighting.name(), GL_COLOR, 0, black.data());
    const std::vector<LightingProgram>& steps = lights.front().steps;
    const auto is_lit = [&](std::size_t step) {
        return steps[step].where == LightingStep::Where::lit;
    };
    std::size_t current = 0; // whose stencil there is
    for (std::size_t step = 0; step < steps.size();) {
        if (!is_lit(step)) {
            draw_step(gl, lights[current], lights[current].steps[step], scene);
            ++step;
            continue;
        }
        std::size_t end = step;
        while (end < steps.size() && is_lit(end)) ++end;
        for (std::size_t light = 0; light < lights.size(); ++light) {
            if (light != current) {
                gl.Disable(GL_BLEND);
                shadow(light);
                begin_lighting(gl, lights[light], target);
                current = light;
            }
            for (std::size_t each = step; each < end; ++each)
                draw_step(gl, lights[light], lights[light].steps[each], scene);
        }
        step = end;
    }
    gl.Disable(GL_BLEND);
    check(gl, "the lighting pass");
}

} // namespace shadowproof
