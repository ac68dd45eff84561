// The steps that techniques share: the uploaded scene, the surface pass, the light pass. Every pass
// sets all the state that it depends on.
#pragma once

#include "raster/gl/context.h"
#include "raster/gl/gl.h"
#include "raster/gl/target.h"
#include "scenes/frame.h"
#include "scenes/scene.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace shadowproof {

/// A point as a sum of two floats per coordinate, exact to 48 bits.
struct TwoFloats {
    glm::vec3 high{0};
    glm::vec3 low{0};
};
TwoFloats split(const glm::dvec3& point);

/// Reversed depths of an orthographic camera, in floats: parallel lines of sight have no infinite
/// projection. What lies in its far plane is drawn, as it is nearer than what is cleared. (Half of
/// the range, so that the viewport multiplies by a power of two.)
DepthModel reversed_parallel_depths(const Scene& scene);

/// What project.vert does to a position p of the scene: clip_from_relative * (p - origin), or, for
/// corners at infinity, clip_from_relative * (p - light, end_w). Points are given as the sum of two
/// floats, and the matrix is computed in double and rounded once.
struct ClipTransform {
    glm::mat4 clip_from_relative{1};
    TwoFloats origin;
    TwoFloats light;   ///< position, or the direction to a light at infinity
    float light_w = 1; ///< 0 at infinity
    /// 0, or a number next to it where lines of sight are parallel: there a corner may go to
    /// infinity straight away from the eye, and have no place in the picture but by its w.
    float end_w = 0;
};
/// Of corners that the CPU moves there, too.
double w_at_infinity(const Camera& camera);
/// In an infinite projection, row z equals row w in all coefficients of directions, so corners at
/// infinity get z == w bit for bit and are not clipped.
ClipTransform clip_transform(const Scene& scene, const DepthModel& depth_model);

/// A buffer of indices, ready to draw as triangles.
struct Triangles {
    Buffer buffer{};
    std::uint32_t count = 0; ///< of triangles
};
/// A buffer with these parts one after the other. OpenGL allows no empty buffer: one without parts
/// holds one unused byte instead.
Buffer make_filled_buffer(const GlFunctions& gl, std::span<const std::span<const std::byte>> parts);

/// Uploads the parts, to be drawn one after the other in one draw call.
Triangles upload_triangles(const GlFunctions& gl,
                           std::span<const std::span<const glm::uvec3>> parts);

/// A run of triangles that are culled alike and have one mask, or none.
struct SurfaceRun {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_count = 0;
    bool double_sided = false;
    std::uint32_t mask = no_mask; ///< index into Geometry::masks
};
/// Covers all triangles in order with the fewest runs.
std::vector<SurfaceRun> surface_runs(const Scene& scene);

/// An alpha mask on the GPU.
struct MaskTexture {
    Texture alpha{};
    GLint wrap_s = 0; ///< values of Wrap
    GLint wrap_t = 0;
    bool nearest = false;
    float least = 0;
};

/// A scene on the GPU.
struct Geometry {
    std::uint32_t position_count = 0;
    Buffer positions{};           ///< the scene's, and then those of the volumes' far ends
    bool ends_at_infinity = true; ///< far ends are the same positions, and the shader moves them
    VertexArray vertices{};
    Triangles surface{}; ///< the scene's triangles
    std::vector<SurfaceRun> runs{};
    Buffer mask_at{}; ///< Scene::mask_at, where it has masks
    std::vector<MaskTexture> masks{};
    Triangles lit_sides{};       ///< from lit_sides.h
    std::uint32_t receivers = 0; ///< how many of them, the first, receive shadows
    Buffer lit_side_indices{};   ///< their indices into Scene::triangles
};
/// `far_ends`: one per position of the scene, or empty for infinity. `more`: points after them,
/// moved away from the light to infinity like far ends.
Geometry upload(const GlFunctions& gl, const Scene& scene, std::span<const glm::vec3> far_ends,
                std::span<const glm::vec3> more = {});

/// Sets the uniforms shared by all vertex shaders that transform as project.vert does.
void set_transform(const GlFunctions& gl, const Program& program, const ClipTransform& transform);
/// Those, and what those that move corners to infinity have besides.
void set_volume_transform(const GlFunctions& gl, const Program& program,
                          const ClipTransform& transform);

/// The stage between a program's vertex and fragment shaders.
enum class Between : std::uint8_t { nothing, geometry_shader };

/// Links project.vert and a shader of the light pass, with the cone of a spot light.
Program link_light(const GlFunctions& gl, const Scene& scene, const ClipTransform& transform,
                   const Geometry& geometry, Between between,
                   std::string_view fragment = "light.frag");

/// Links project.vert and a fragment shader, with the scene's vertices under the transform.
Program link_projection(const GlFunctions& gl, std::string_view fragment,
                        const ClipTransform& transform, const Geometry& geometry,
                        Between between = Between::nothing);

/// Two programs of a pass that draws surfaces: of those that are whole, and, where the scene has
/// masks, of those that have one.
struct SurfacePrograms {
    Program whole{};
    Program masked{};

    const Program& of(const SurfaceRun& run) const { return run.mask == no_mask ? whole : masked; }
};

/// Those of draw_surface.
SurfacePrograms link_surface(const GlFunctions& gl, const ClipTransform& transform,
                             const Geometry& geometry, Between between = Between::nothing);

/// Binds a run's mask, if it has one, and its program.
void use(const GlFunctions& gl, const SurfacePrograms& programs, const Geometry& geometry,
         const SurfaceRun& run);

void draw_triangles(const GlFunctions& gl, const Geometry& geometry, const Triangles& triangles,
                    std::uint32_t first, std::uint32_t count);

/// Draws in batches small enough for a software driver's memory: llvmpipe sorts triangles into
/// tiles faster than it draws them, and keeps up to 64 scenes of 36 MB. Primitives are numbered
/// from zero in each draw call.
void draw_volume_faces(const GlFunctions& gl, const Geometry& geometry, const Triangles& faces);

/// Sets the state of a whole frame: how depth is computed, which side is the front.
void begin_frame(const GlFunctions& gl, const Target& target, const Geometry& geometry,
                 const DepthModel& depth_model);
/// Back to OpenGL's initial values.
void end_frame(const GlFunctions& gl);

/// The range of visible depths. Where the projection clips at near and far itself, everything that
/// is left is visible.
struct VisibleDepths {
    float near = 0;
    float far = std::numeric_limits<float>::infinity();
    bool of_clip = false; ///< z of the clip coordinates; else view depths, along perspective lines
};

/// Clears the target, the stencil to `stencil`, and draws the nearest surfaces:
/// Visibility::shadowed, depth and triangle.
void draw_surface(const GlFunctions& gl, const SurfacePrograms& surface, const Target& target,
                  const Geometry& geometry, const DepthModel& depth_model,
                  const VisibleDepths& visible, std::uint8_t stencil);

/// Sets the stencil alone, for another light over the same surfaces.
void clear_stencil(const GlFunctions& gl, const Target& target, std::uint8_t stencil);

/// Draws the lit sides again, as Visibility::lit, where the depth is equal and the counter is zero
/// or the light's shader finds no shadow, or where they receive no shadows. Writes neither stencil
/// nor depth.
void draw_light(const GlFunctions& gl, const Program& light, const Target& target,
                const Geometry& geometry, Counter counter);

} // namespace shadowproof
