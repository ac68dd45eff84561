#include "raster/passes/passes.h"

#include "raster/gl/shader.h"
#include "raster/passes/lit_sides.h"
#include "scenes/error.h"
#include "scenes/plan/plan.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <string>

namespace shadowproof {

namespace {

/// Rounds to float through memory, because gcc 12 at -O2 drops the conversion of two neighbours to
/// float and back.
float rounded(double value) {
    const volatile float nearest = static_cast<float>(value);
    return nearest;
}

/// The least float that is not below: what is not below the one is not below the other.
float float_not_below(double value) {
    const float nearest = rounded(value);
    return double{nearest} < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                                   : nearest;
}

glm::dmat4 clip_from_view(const Camera& camera, const DepthModel& model) {
    switch (model.projection) {
    case DepthModel::Projection::finite:
        return clip_from_view_finite(camera, model.far);
    case DepthModel::Projection::finite_reversed:
        return clip_from_view_finite_reversed(camera, model.far);
    case DepthModel::Projection::infinite:
        return clip_from_view_infinite(camera);
    case DepthModel::Projection::infinite_reversed:
        return clip_from_view_infinite_reversed(camera);
    }
    assert(false);
    return glm::dmat4(1);
}

} // namespace

TwoFloats split(const glm::dvec3& point) {
    TwoFloats sum;
    for (int k = 0; k < 3; ++k) {
        sum.high[k] = rounded(point[k]);
        sum.low[k] = rounded(point[k] - double{sum.high[k]});
    }
    return sum;
}

DepthModel reversed_parallel_depths(const Scene& scene) {
    return {.projection = DepthModel::Projection::finite_reversed,
            .near = scene.camera.near,
            .far = finite_far(scene),
            .parallel = true,
            .floating = true,
            .eye_relative = true,
            .front = 0.5};
}

/// Far beyond what floats tell from infinity, and far from their own end.
double w_at_infinity(const Camera& camera) {
    return camera.is_orthographic() ? 0x1p-60 : 0;
}

ClipTransform clip_transform(const Scene& scene, const DepthModel& depth_model) {
    const glm::dmat4 projection = clip_from_view(scene.camera, depth_model);
    ClipTransform transform;
    if (depth_model.eye_relative) {
        transform.origin = split(scene.camera.eye);
        transform.clip_from_relative =
            glm::mat4(projection * glm::dmat4(view_from_eye_relative(scene.camera)));
    } else {
        transform.clip_from_relative = glm::mat4(projection * view_from_world(scene.camera));
    }
    const glm::dvec4 light = homogeneous(chosen_light(scene));
    transform.light = split(light);
    transform.light_w = static_cast<float>(light.w);
    transform.end_w = static_cast<float>(w_at_infinity(scene.camera));
    return transform;
}

Buffer make_filled_buffer(const GlFunctions& gl,
                          std::span<const std::span<const std::byte>> parts) {
    std::size_t size = 0;
    for (const auto& part : parts) size += part.size();
    Buffer buffer = make_buffer(gl);
    gl.NamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(std::max<std::size_t>(size, 1)),
                          nullptr, GL_DYNAMIC_STORAGE_BIT);
    std::size_t offset = 0;
    for (const auto& part : parts) {
        if (!part.empty())
            gl.NamedBufferSubData(buffer.name(), static_cast<GLintptr>(offset),
                                  static_cast<GLsizeiptr>(part.size()), part.data());
        offset += part.size();
    }
    return buffer;
}

Triangles upload_triangles(const GlFunctions& gl,
                           std::span<const std::span<const glm::uvec3>> parts) {
    std::vector<std::span<const std::byte>> bytes;
    std::size_t count = 0;
    for (const auto& part : parts) {
        bytes.push_back(std::as_bytes(part));
        count += part.size();
    }
    // glDrawElements takes the number of indices as an int.
    if (count > std::size_t{std::numeric_limits<GLsizei>::max()} / 3)
        throw Error("scene", std::to_string(count) + " triangles in one draw call are too many",
                    "split the scene");
    return {make_filled_buffer(gl, bytes), static_cast<std::uint32_t>(count)};
}

std::vector<SurfaceRun> surface_runs(const Scene& scene) {
    std::vector<SurfaceRun> runs;
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[mesh.material];
        if (runs.empty() || runs.back().double_sided != material.double_sided ||
            runs.back().mask != material.mask)
            runs.push_back({mesh.first_triangle, 0, material.double_sided, material.mask});
        runs.back().triangle_count += mesh.triangle_count;
    }
    return runs;
}

namespace {

MaskTexture upload_mask(const GlFunctions& gl, const Scene& scene, const AlphaMask& mask) {
    MaskTexture made{.alpha = make_texture(gl, GL_TEXTURE_2D),
                     .wrap_s = static_cast<GLint>(mask.wrap_s),
                     .wrap_t = static_cast<GLint>(mask.wrap_t),
                     .nearest = mask.nearest,
                     .least = float_not_below(mask.least)};
    const GLuint name = made.alpha.name();
    GLint most = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (std::max(mask.alpha.width, mask.alpha.height) > most)
        throw Error(scene.file.string() + ": " + mask.name,
                    "the driver takes at most " + std::to_string(most) + " texels a side",
                    "make the image smaller");
    gl.TextureStorage2D(name, 1, GL_R32F, mask.alpha.width, mask.alpha.height);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.TextureSubImage2D(name, 0, 0, 0, mask.alpha.width, mask.alpha.height, GL_RED, GL_FLOAT,
                         mask.alpha.pixels.data());
    gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST); // texels are fetched
    gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return made;
}

/// Coordinates of all vertices, of which only the scene's have some.
void upload_masks(const GlFunctions& gl, const Scene& scene, std::size_t vertices,
                  Geometry& geometry) {
    std::vector<glm::vec2> at = scene.mask_at;
    at.resize(vertices);
    geometry.mask_at = make_filled_buffer(gl, std::array{std::as_bytes(std::span(at))});
    const GLuint name = geometry.vertices.name();
    gl.VertexArrayVertexBuffer(name, 1, geometry.mask_at.name(), 0, sizeof(glm::vec2));
    gl.VertexArrayAttribFormat(name, 1, 2, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(name, 1, 1);
    gl.EnableVertexArrayAttrib(name, 1);
    for (const AlphaMask& mask : scene.masks)
        geometry.masks.push_back(upload_mask(gl, scene, mask));
}

} // namespace

Geometry upload(const GlFunctions& gl, const Scene& scene, std::span<const glm::vec3> far_ends,
                std::span<const glm::vec3> more) {
    Geometry geometry{.position_count = static_cast<std::uint32_t>(scene.positions.size()),
                      .ends_at_infinity = far_ends.empty(),
                      .vertices = make_vertex_array(gl),
                      .runs = surface_runs(scene)};
    const std::span<const std::byte> positions = std::as_bytes(std::span(scene.positions));
    const std::span<const std::byte> ends = far_ends.empty() ? positions : std::as_bytes(far_ends);
    geometry.positions = make_filled_buffer(gl, std::array{positions, ends, std::as_bytes(more)});
    const GLuint vertices = geometry.vertices.name();
    gl.VertexArrayVertexBuffer(vertices, 0, geometry.positions.name(), 0, sizeof(glm::vec3));
    gl.VertexArrayAttribFormat(vertices, 0, 3, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(vertices, 0, 0);
    gl.EnableVertexArrayAttrib(vertices, 0);
    if (has_masks(scene))
        upload_masks(gl, scene, 2 * scene.positions.size() + more.size(), geometry);
    geometry.surface = upload_triangles(gl, std::array{std::span(scene.triangles)});

    const LitSides sides = lit_sides(scene);
    geometry.receivers = static_cast<std::uint32_t>(sides.receivers);
    std::vector<glm::uvec3> triangles;
    for (const std::uint32_t triangle : sides.triangles)
        triangles.push_back(scene.triangles[triangle]);
    geometry.lit_sides = upload_triangles(gl, std::array{std::span<const glm::uvec3>(triangles)});
    geometry.lit_side_indices =
        make_filled_buffer(gl, std::array{std::as_bytes(std::span(sides.triangles))});
    check(gl, "uploading the scene");
    return geometry;
}

void set_transform(const GlFunctions& gl, const Program& program, const ClipTransform& transform) {
    // Locations as project.vert lays them out.
    gl.ProgramUniformMatrix4fv(program.name(), 0, 1, GL_FALSE,
                               glm::value_ptr(transform.clip_from_relative));
    gl.ProgramUniform3fv(program.name(), 1, 1, glm::value_ptr(transform.origin.high));
    gl.ProgramUniform3fv(program.name(), 2, 1, glm::value_ptr(transform.origin.low));
    gl.ProgramUniform3fv(program.name(), 3, 1, glm::value_ptr(transform.light.high));
    gl.ProgramUniform3fv(program.name(), 4, 1, glm::value_ptr(transform.light.low));
    gl.ProgramUniform1f(program.name(), 11, transform.light_w);
}

void set_volume_transform(const GlFunctions& gl, const Program& program,
                          const ClipTransform& transform) {
    set_transform(gl, program, transform);
    gl.ProgramUniform1f(program.name(), 35, transform.end_w);
}

Program link_projection(const GlFunctions& gl, std::string_view fragment,
                        const ClipTransform& transform, const Geometry& geometry, Between between) {
    Program program = between == Between::geometry_shader
                          ? link_files(gl, {"project.vert", "surface.geom", fragment})
                          : link_files(gl, {"project.vert", fragment});
    set_volume_transform(gl, program, transform);
    gl.ProgramUniform1i(program.name(), 5,
                        geometry.ends_at_infinity ? static_cast<GLint>(geometry.position_count)
                                                  : std::numeric_limits<GLint>::max());
    return program;
}

SurfacePrograms link_surface(const GlFunctions& gl, const ClipTransform& transform,
                             const Geometry& geometry, Between between) {
    SurfacePrograms programs{link_projection(gl, "surface.frag", transform, geometry, between)};
    if (!geometry.masks.empty())
        programs.masked = link_projection(gl, "surface_masked.frag", transform, geometry, between);
    return programs;
}

void use(const GlFunctions& gl, const SurfacePrograms& programs, const Geometry& geometry,
         const SurfaceRun& run) {
    const Program& program = programs.of(run);
    gl.UseProgram(program.name());
    if (run.mask == no_mask) return;
    const MaskTexture& mask = geometry.masks[run.mask];
    // As mask.glsl lays them out.
    gl.BindTextureUnit(6, mask.alpha.name());
    gl.ProgramUniform1f(program.name(), 31, mask.least);
    gl.ProgramUniform1i(program.name(), 32, mask.wrap_s);
    gl.ProgramUniform1i(program.name(), 33, mask.wrap_t);
    gl.ProgramUniform1i(program.name(), 34, mask.nearest ? 1 : 0);
}

Program link_light(const GlFunctions& gl, const Scene& scene, const ClipTransform& transform,
                   const Geometry& geometry, Between between, std::string_view fragment) {
    Program program = link_projection(gl, fragment, transform, geometry, between);
    const Light& light = chosen_light(scene);
    const bool spot = light.kind == Light::Kind::spot;
    const glm::vec3 axis(light.direction);
    gl.ProgramUniform3fv(program.name(), 13, 1, glm::value_ptr(axis));
    gl.ProgramUniform1f(program.name(), 14,
                        spot ? static_cast<float>(std::cos(light.outer_cone)) : -2.0F);
    return program;
}

void begin_frame(const GlFunctions& gl, const Target& target, const Geometry& geometry,
                 const DepthModel& depth_model) {
    const bool reversed = depth_model.reversed();
    gl.Viewport(0, 0, target.width, target.height);
    gl.ClipControl(GL_LOWER_LEFT, reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    gl.DepthRange(depth_model.front, 1);
    set_enabled(gl, GL_DEPTH_CLAMP, depth_model.clamp);
    gl.FrontFace(GL_CCW);
    gl.CullFace(GL_BACK);
    gl.Enable(GL_DEPTH_TEST);
    gl.BindVertexArray(geometry.vertices.name());
}

void end_frame(const GlFunctions& gl) {
    gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl.DepthRange(0, 1);
    for (const GLenum capability : {GL_DEPTH_CLAMP, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE})
        gl.Disable(capability);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.StencilMask(~0U);
    gl.BindVertexArray(0);
    gl.UseProgram(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void draw_triangles(const GlFunctions& gl, const Geometry& geometry, const Triangles& triangles,
                    std::uint32_t first, std::uint32_t count) {
    gl.VertexArrayElementBuffer(geometry.vertices.name(), triangles.buffer.name());
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(std::size_t{3} * sizeof(GLuint) * first));
}

void draw_volume_faces(const GlFunctions& gl, const Geometry& geometry, const Triangles& faces) {
    constexpr std::uint32_t most_at_once = 1U << 18U;
    for (std::uint32_t first = 0; first < faces.count; first += most_at_once) {
        if (first > 0) gl.Finish();
        draw_triangles(gl, geometry, faces, first, std::min(faces.count - first, most_at_once));
    }
}

namespace {

/// Draws nothing, into another range of depths. Mesa 22.3's llvmpipe finds the range that clamps
/// depths when a viewport's scale or offset changes, not when the clip control does: depths from
/// [0, 1] drawn into [0.5, 1] have those of depths from [-1, 1] drawn into [0, 1], and either would
/// be clamped to the range of the other.
void renew_depth_range(const GlFunctions& gl, const SurfacePrograms& surface,
                       const Geometry& geometry, double front) {
    gl.Enable(GL_RASTERIZER_DISCARD);
    gl.DepthRange(0.25, 1);
    gl.UseProgram(surface.whole.name());
    draw_triangles(gl, geometry, geometry.surface, 0, 1);
    gl.DepthRange(front, 1);
    gl.Disable(GL_RASTERIZER_DISCARD);
}

} // namespace

void draw_surface(const GlFunctions& gl, const SurfacePrograms& surface, const Target& target,
                  const Geometry& geometry, const DepthModel& depth_model,
                  const VisibleDepths& visible, std::uint8_t stencil) {
    const bool reversed = depth_model.reversed();
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.StencilMask(~0U);
    gl.Disable(GL_STENCIL_TEST);
    gl.DepthFunc(reversed ? GL_GREATER : GL_LESS);

    const GLuint framebuffer = target.surface.name();
    constexpr std::array<GLfloat, 4> background{0, 0, 0, 0};
    constexpr std::array<GLuint, 4> nothing{no_triangle, no_triangle, no_triangle, no_triangle};
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, background.data());
    gl.ClearNamedFramebufferuiv(framebuffer, GL_COLOR, 1, nothing.data());
    gl.ClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, reversed ? 0.0F : 1.0F, stencil);

    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    if (depth_model.clamp && geometry.surface.count > 0)
        renew_depth_range(gl, surface, geometry, depth_model.front);
    for (const SurfaceRun& run : geometry.runs) {
        use(gl, surface, geometry, run);
        set_enabled(gl, GL_CULL_FACE, !run.double_sided);
        // Locations as surface.glsl lays them out.
        gl.ProgramUniform2f(surface.of(run).name(), 6, visible.near, visible.far);
        gl.ProgramUniform1i(surface.of(run).name(), 8, visible.of_clip ? 1 : 0);
        gl.ProgramUniform1ui(surface.of(run).name(), 7, run.first_triangle);
        draw_triangles(gl, geometry, geometry.surface, run.first_triangle, run.triangle_count);
    }
    check(gl, "the surface pass");
}

void clear_stencil(const GlFunctions& gl, const Target& target, std::uint8_t stencil) {
    const GLint value = stencil;
    gl.StencilMask(0xff);
    gl.ClearNamedFramebufferiv(target.surface.name(), GL_STENCIL, 0, &value);
}

void draw_light(const GlFunctions& gl, const Program& light, const Target& target,
                const Geometry& geometry, Counter counter) {
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_FALSE);
    gl.DepthFunc(GL_EQUAL);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilMask(0);
    const bool stencil = counter == Counter::stencil;
    gl.StencilFunc(stencil ? GL_EQUAL : GL_ALWAYS, 0, ~0U);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl.Disable(GL_CULL_FACE); // a side that is culled in the surface pass is not the one seen

    gl.BindFramebuffer(GL_FRAMEBUFFER, target.light.name());
    gl.UseProgram(light.name());
    gl.BindTextureUnit(0, target.triangle.name());
    gl.BindTextureUnit(1, target.sum.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, geometry.lit_side_indices.name());
    const auto draw = [&](std::uint32_t first, std::uint32_t count) {
        gl.ProgramUniform1ui(light.name(), 7, first);
        draw_triangles(gl, geometry, geometry.lit_sides, first, count);
    };
    gl.ProgramUniform1i(light.name(), 12, stencil ? 0 : 1);
    draw(0, geometry.receivers);
    gl.StencilFunc(GL_ALWAYS, 0, ~0U);
    gl.ProgramUniform1i(light.name(), 12, 0);
    draw(geometry.receivers, geometry.lit_sides.count - geometry.receivers);
    check(gl, "the light pass");
}

} // namespace shadowproof
