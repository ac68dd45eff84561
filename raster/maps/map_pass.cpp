#include "raster/maps/map_pass.h"

#include "raster/gl/shader.h"
#include "scenes/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

namespace shadowproof {

namespace {

constexpr GLfloat farthest_depth = 1;

/// The nearest texel; beside the texture that of its border.
void set_nearest(const GlFunctions& gl, const Texture& texture) {
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Texture make_texture_of(const GlFunctions& gl, const MapModel& model) {
    const bool cube = model.shape == MapModel::Shape::cube;
    GLint most = 0;
    gl.GetIntegerv(cube ? GL_MAX_CUBE_MAP_TEXTURE_SIZE : GL_MAX_TEXTURE_SIZE, &most);
    if (model.size > most)
        throw Error(fmt::format("--map-size {}", model.size),
                    fmt::format("is more than the driver's {} texels a side", most),
                    "ask for a smaller map");
    Texture texture = make_texture(gl, cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D);
    gl.TextureStorage2D(texture.name(), 1, gl_format(model.format), model.size, model.size);
    set_nearest(gl, texture);
    return texture;
}

Texture make_depth(const GlFunctions& gl, const MapModel& model) {
    Texture depth = make_texture(gl, GL_TEXTURE_2D);
    gl.TextureStorage2D(depth.name(), 1, GL_DEPTH_COMPONENT24, model.size, model.size);
    return depth;
}

/// One row, whose texels hold their own number.
Texture make_ramp(const GlFunctions& gl) {
    Texture ramp = make_texture(gl, GL_TEXTURE_2D);
    std::array<std::uint8_t, ramp_steps> steps{};
    for (std::size_t step = 0; step < steps.size(); ++step)
        steps[step] = static_cast<std::uint8_t>(step);
    gl.TextureStorage2D(ramp.name(), 1, GL_R8, ramp_steps, 1);
    gl.TextureSubImage2D(ramp.name(), 0, 0, 0, ramp_steps, 1, GL_RED, GL_UNSIGNED_BYTE,
                         steps.data());
    set_nearest(gl, ramp);
    return ramp;
}

Framebuffer make_face(const GlFunctions& gl, const MapPass& pass, std::size_t face) {
    Framebuffer framebuffer = make_framebuffer(gl);
    if (pass.model.is_ramp()) {
        gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, pass.texture.name(),
                                   0);
        gl.NamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, pass.depth.name(), 0);
        return framebuffer;
    }
    if (pass.model.shape == MapModel::Shape::cube)
        gl.NamedFramebufferTextureLayer(framebuffer.name(), GL_DEPTH_ATTACHMENT,
                                        pass.texture.name(), 0, static_cast<GLint>(face));
    else
        gl.NamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, pass.texture.name(), 0);
    return framebuffer;
}

/// The light's camera at one face. Points are relative to the light.
ClipTransform transform_of(const Scene& scene, const MapModel& model, std::size_t face) {
    Scene seen_from_light;
    seen_from_light.lights = {chosen_light(scene)};
    seen_from_light.camera = map_camera(chosen_light(scene), model, face);
    return clip_transform(seen_from_light, map_depth_model(model));
}

std::string_view fragment_of(const MapModel& model, bool masked) {
    if (model.is_ramp()) return masked ? "map_ramp_masked.frag" : "map_ramp.frag";
    if (model.value == MapValue::distance)
        return masked ? "map_distance_masked.frag" : "map_distance.frag";
    return masked ? "map_depth_masked.frag" : "map_depth.frag";
}

Program link_all_faces(const GlFunctions& gl, const Scene& scene, const MapModel& model,
                       bool masked) {
    Program program = link_files(gl, {"project.vert", "map_cube.geom", fragment_of(model, masked)});
    set_transform(gl, program, transform_of(scene, model, 0));
    std::vector<glm::mat4> clip_from_light;
    for (std::size_t face = 0; face < model.faces(); ++face)
        clip_from_light.push_back(transform_of(scene, model, face).clip_from_relative);
    gl.ProgramUniformMatrix4fv(program.name(), 20, 6, GL_FALSE,
                               glm::value_ptr(clip_from_light.front()));
    return program;
}

template <class Link>
SurfacePrograms link_both(const Geometry& geometry, const Link& link) {
    SurfacePrograms programs{link(false)};
    if (!geometry.masks.empty()) programs.masked = link(true);
    return programs;
}

std::vector<SurfaceRun> casting_runs(const Scene& scene) {
    std::vector<SurfaceRun> runs;
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.casts) continue;
        const std::uint32_t mask = scene.materials[mesh.material].mask;
        const bool adjoins =
            !runs.empty() && runs.back().mask == mask &&
            runs.back().first_triangle + runs.back().triangle_count == mesh.first_triangle;
        if (adjoins)
            runs.back().triangle_count += mesh.triangle_count;
        else
            runs.push_back({mesh.first_triangle, mesh.triangle_count, true, mask});
    }
    return runs;
}

/// Locations as map_ramp.frag and map_ramp.glsl lay them out.
void set_ramp(const GlFunctions& gl, const Program& program, const Camera& camera) {
    gl.ProgramUniform2f(program.name(), 16, static_cast<float>(camera.near),
                        static_cast<float>(camera.far));
    const glm::mat3 matrix = map_from_world(camera);
    gl.ProgramUniformMatrix3fv(program.name(), 18, 1, GL_FALSE, glm::value_ptr(matrix));
}

void set_culling(const GlFunctions& gl, MapCulling culling) {
    set_enabled(gl, GL_CULL_FACE, culling != MapCulling::none);
    gl.CullFace(culling == MapCulling::front ? GL_FRONT : GL_BACK);
}

} // namespace

GLenum gl_format(MapFormat format) {
    switch (format) {
    case MapFormat::d16:
        return GL_DEPTH_COMPONENT16;
    case MapFormat::d24:
        return GL_DEPTH_COMPONENT24;
    case MapFormat::ramp8:
        return GL_R8;
    case MapFormat::d32f:
        break;
    }
    return GL_DEPTH_COMPONENT32F;
}

glm::mat3 map_from_world(const Camera& camera) {
    return glm::transpose(glm::dmat3(camera.right / camera.half_height,
                                     camera.up / camera.half_height, camera.forward));
}

MapPass make_map_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                      const MapModel& model, MapMaking making) {
    MapPass pass{.model = model,
                 .making = making,
                 .texture = make_texture_of(gl, model),
                 .casters = casting_runs(scene)};
    if (model.is_ramp()) {
        pass.depth = make_depth(gl, model);
        pass.ramp = make_ramp(gl);
    }
    for (std::size_t face = 0; face < model.faces(); ++face)
        pass.faces.push_back(make_face(gl, pass, face));
    if (making == MapMaking::geometry_shader) {
        pass.all = make_framebuffer(gl);
        gl.NamedFramebufferTexture(pass.all.name(), GL_DEPTH_ATTACHMENT, pass.texture.name(), 0);
        pass.programs.push_back(link_both(
            geometry, [&](bool masked) { return link_all_faces(gl, scene, model, masked); }));
    } else {
        for (std::size_t face = 0; face < model.faces(); ++face)
            pass.programs.push_back(link_both(geometry, [&](bool masked) {
                return link_projection(gl, fragment_of(model, masked),
                                       transform_of(scene, model, face), geometry);
            }));
    }
    const auto set = [&](const Program& program) {
        if (model.value == MapValue::distance)
            gl.ProgramUniform1f(program.name(), 6, static_cast<float>(model.far));
        if (model.is_ramp()) set_ramp(gl, program, map_camera(chosen_light(scene), model, 0));
        // No corner is moved to infinity.
        gl.ProgramUniform1i(program.name(), 5, static_cast<GLint>(geometry.position_count));
    };
    for (const SurfacePrograms& programs : pass.programs) {
        set(programs.whole);
        if (has_masks(scene)) set(programs.masked);
    }
    check(gl, "making the shadow map");
    return pass;
}

void draw_map(const GlFunctions& gl, const MapPass& pass, const Geometry& geometry) {
    gl.Viewport(0, 0, pass.model.size, pass.model.size);
    gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl.DepthRange(0, 1);
    gl.Disable(GL_DEPTH_CLAMP);
    gl.Disable(GL_STENCIL_TEST);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    gl.FrontFace(GL_CCW);
    set_culling(gl, pass.model.culling);
    set_enabled(gl, GL_POLYGON_OFFSET_FILL, pass.model.has_offset());
    gl.PolygonOffset(static_cast<GLfloat>(pass.model.slope_bias),
                     static_cast<GLfloat>(pass.model.offset_units));
    gl.BindVertexArray(geometry.vertices.name());
    gl.BindTextureUnit(3, pass.ramp.name());
    const bool at_once = pass.making == MapMaking::geometry_shader;
    for (std::size_t i = 0; i < pass.programs.size(); ++i) {
        const GLuint framebuffer = at_once ? pass.all.name() : pass.faces[i].name();
        gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &farthest_depth);
        if (pass.model.is_ramp()) {
            constexpr std::array<GLfloat, 4> last_step{1, 1, 1, 1};
            gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, last_step.data());
        }
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        for (const SurfaceRun& run : pass.casters) {
            use(gl, pass.programs[i], geometry, run);
            draw_triangles(gl, geometry, geometry.surface, run.first_triangle, run.triangle_count);
        }
    }
    gl.CullFace(GL_BACK);
    gl.Disable(GL_POLYGON_OFFSET_FILL);
    check(gl, "drawing the shadow map");
}

DepthFormat format_of(const GlFunctions& gl, const MapPass& pass) {
    if (!pass.model.is_ramp()) return depth_format(gl, pass.texture);
    DepthFormat format;
    gl.GetTextureLevelParameteriv(pass.texture.name(), 0, GL_TEXTURE_RED_SIZE, &format.bits);
    return format;
}

std::vector<Image<float>> read_map(const GlFunctions& gl, const MapPass& pass) {
    const int size = pass.model.size;
    std::vector<Image<float>> faces;
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    for (const Framebuffer& face : pass.faces) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, face.name());
        Image<float> bottom_up(size, size);
        gl.ReadPixels(0, 0, size, size, pass.model.is_ramp() ? GL_RED : GL_DEPTH_COMPONENT,
                      GL_FLOAT, bottom_up.pixels.data());
        // OpenGL's rows run from the bottom.
        for (int y = 0; y < size / 2; ++y) {
            const auto row = [&](int from_top) {
                return bottom_up.pixels.begin() + std::ptrdiff_t{from_top} * size;
            };
            std::swap_ranges(row(y), row(y) + size, row(size - 1 - y));
        }
        faces.push_back(std::move(bottom_up));
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    check(gl, "reading the shadow map back");
    return faces;
}

} // namespace shadowproof
