// Draws the casters as the light sees them into a texture of depths, or of their steps on a ramp.
#pragma once

#include "raster/passes/passes.h"
#include "scenes/shadow_map.h"

#include <glm/mat3x3.hpp>
#include <vector>

namespace shadowproof {

/// How the faces of a cube are drawn.
enum class MapMaking : std::uint8_t {
    pass_per_face,
    geometry_shader, ///< one pass, which sends each triangle to all six layers
};

struct MapPass {
    MapModel model;
    MapMaking making = MapMaking::pass_per_face;
    Texture texture{};                       ///< of depths or steps; a cube map, or a plain one
    Texture depth{};                         ///< with a ramp only: of the casters that are drawn
    Texture ramp{};                          ///< with a ramp only
    std::vector<Framebuffer> faces{};        ///< one for each
    Framebuffer all{};                       ///< all faces as layers; with a geometry shader only
    std::vector<SurfacePrograms> programs{}; ///< one per pass
    std::vector<SurfaceRun> casters{};       ///< what is drawn
};

/// OpenGL's name of the format.
GLenum gl_format(MapFormat format);

/// From the world's axes to those of a face's camera: right and up over its half side at depth 1,
/// and forward.
glm::mat3 map_from_world(const Camera& camera);

/// `geometry`: the scene's. The model's size must not exceed the driver's; throws Error.
MapPass make_map_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                      const MapModel& model, MapMaking making);

/// Leaves viewport, culling, depth state, framebuffer and texture unit 3 changed.
void draw_map(const GlFunctions& gl, const MapPass& pass, const Geometry& geometry);

/// The format of the texture that the driver reports, whatever was requested.
DepthFormat format_of(const GlFunctions& gl, const MapPass& pass);

/// One picture per face, rows from the top.
std::vector<Image<float>> read_map(const GlFunctions& gl, const MapPass& pass);

} // namespace shadowproof
