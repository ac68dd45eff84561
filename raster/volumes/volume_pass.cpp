#include "raster/volumes/volume_pass.h"

#include "raster/gl/shader.h"
#include "raster/volumes/volume.h"
#include "scenes/mesh/half_edge.h"
#include "scenes/mesh/topology.h"
#include "scenes/orientation.h"

#include <array>
#include <memory>
#include <numeric>

namespace shadowproof {

namespace {

/// The inputs of a pass.
struct Making {
    const GlFunctions& gl;
    const Scene& scene;
    const Geometry& geometry;
    const ClipTransform& transform;
    VolumeCaps caps;
};

std::vector<std::span<const glm::uvec3>> drawn_parts(const ShadowVolume& volume,
                                                     const VolumeCaps& caps) {
    std::vector<std::span<const glm::uvec3>> parts{volume.sides};
    if (caps.light) parts.emplace_back(volume.light_cap);
    if (caps.dark) parts.emplace_back(volume.dark_cap);
    return parts;
}

VolumePass cpu_pass(const Making& making, Between surfaces, const Extruder& extruder) {
    struct Made {
        Program program;
        Triangles faces;
        Triangles flipped;
    };
    const auto made = std::make_shared<Made>();
    made->program =
        link_projection(making.gl, "volume.frag", making.transform, making.geometry, surfaces);
    return {.update =
                [made, making, extruder] {
                    const ShadowVolume volume = extruder();
                    made->faces = upload_triangles(making.gl, drawn_parts(volume, making.caps));
                    std::vector<std::span<const glm::uvec3>> flipped{volume.flipped_sides};
                    if (making.caps.light) flipped.emplace_back(volume.flipped_caps);
                    made->flipped = upload_triangles(making.gl, flipped);
                },
            .draw =
                [made, making] {
                    making.gl.UseProgram(made->program.name());
                    draw_volume_faces(making.gl, making.geometry, made->faces);
                },
            .draw_flipped =
                [made, making] {
                    making.gl.UseProgram(made->program.name());
                    draw_volume_faces(making.gl, making.geometry, made->flipped);
                },
            .programs = {made->program.name()}};
}

/// Sets the light for shaders that compute facing in double; locations as in the users of
/// facing.glsl.
void set_light(const Making& making, const Program& program) {
    const glm::dvec4 light = homogeneous(chosen_light(making.scene));
    making.gl.ProgramUniform3d(program.name(), 8, light.x, light.y, light.z);
}

/// The corner of a half-edge's triangle that is not on it.
std::uint32_t third_corner(const HalfEdgeMesh& mesh, std::uint32_t half_edge) {
    return mesh.half_edges[mesh.half_edges[mesh.half_edges[half_edge].next].next].origin;
}

/// The third corner of the triangle across; the triangle's own where there is none.
std::uint32_t corner_across(const HalfEdgeMesh& mesh, std::uint32_t half_edge) {
    const std::uint32_t twin = mesh.half_edges[half_edge].twin;
    return third_corner(mesh, twin == no_half_edge ? half_edge : twin);
}

VolumePass geometry_shader_pass(const Making& making) {
    struct Made {
        Program program;
        Buffer indices;
        GLsizei count = 0;
    };
    const auto made = std::make_shared<Made>();
    const HalfEdgeMesh mesh = connect_all(making.scene);
    std::vector<std::uint32_t> indices;
    for (std::uint32_t half_edge = 0; half_edge < mesh.half_edges.size(); ++half_edge) {
        indices.push_back(mesh.half_edges[half_edge].origin);
        indices.push_back(corner_across(mesh, half_edge));
    }
    made->indices = make_filled_buffer(making.gl, std::array{std::as_bytes(std::span(indices))});
    made->count = static_cast<GLsizei>(indices.size());
    made->program = link_files(making.gl, {"adjacency.vert", "volume.geom", "volume.frag"});
    set_volume_transform(making.gl, made->program, making.transform);
    const auto draw = [made, making](bool flipped) {
        const GlFunctions& gl = making.gl;
        const GLuint program = made->program.name();
        gl.ProgramUniform1i(program, 9, making.caps.light && !flipped ? 1 : 0);
        gl.ProgramUniform1i(program, 10, making.caps.dark && !flipped ? 1 : 0);
        gl.ProgramUniform1i(program, 12, flipped ? 1 : 0);
        gl.UseProgram(program);
        gl.VertexArrayElementBuffer(making.geometry.vertices.name(), made->indices.name());
        gl.DrawElements(GL_TRIANGLES_ADJACENCY, made->count, GL_UNSIGNED_INT, nullptr);
    };
    return {.update = [made, making] { set_light(making, made->program); },
            .draw = [draw] { draw(false); },
            .draw_flipped = [draw] { draw(true); },
            .programs = {made->program.name()}};
}

constexpr std::uint32_t no_corner = 0xffffffffU;

/// As degenerate_quads.vert reads it.
struct QuadEdge {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t up = no_corner;
    std::uint32_t down = no_corner;
};

/// Two triangles in one plane, side by side: the light never sees one of them alone.
bool is_flat(const Scene& scene, const QuadEdge& edge) {
    const glm::dvec3 low = scene.positions[edge.low];
    const glm::dvec3 high = scene.positions[edge.high];
    const glm::dvec3 upper = scene.positions[edge.up];
    const glm::dvec3 lower = scene.positions[edge.down];
    if (orientation(low, high, upper, glm::dvec4(lower, 1)) != 0) return false;
    const glm::dvec3 up = glm::cross(high - low, upper - low);
    return glm::dot(up, glm::cross(lower - low, high - low)) > 0;
}

/// All edges that may become silhouettes.
std::vector<QuadEdge> quad_edges(const Scene& scene) {
    const HalfEdgeMesh mesh = connect_all(scene);
    std::vector<QuadEdge> edges;
    for (const Edge& edge : mesh.edges) {
        const std::uint32_t a = mesh.half_edges[edge.half_edge].origin;
        const std::uint32_t b = mesh.half_edges[mesh.half_edges[edge.half_edge].next].origin;
        const std::uint32_t own = third_corner(mesh, edge.half_edge);
        const std::uint32_t other =
            edge.twin == no_half_edge ? no_corner : third_corner(mesh, edge.twin);
        const QuadEdge quad = a < b ? QuadEdge{a, b, own, other} : QuadEdge{b, a, other, own};
        if (edge.twin == no_half_edge || !is_flat(scene, quad)) edges.push_back(quad);
    }
    return edges;
}

VolumePass degenerate_quads_pass(const Making& making) {
    struct Made {
        Program quads;
        Program caps;
        Buffer edges;
        Buffer corners;
        VertexArray no_attributes; ///< shaders fetch vertices themselves
        GLsizei quad_vertices = 0;
        GLsizei cap_vertices = 0; ///< of light or dark caps
    };
    const auto made = std::make_shared<Made>();
    const std::vector<QuadEdge> edges = quad_edges(making.scene);
    made->edges = make_filled_buffer(making.gl, std::array{std::as_bytes(std::span(edges))});
    made->corners =
        make_filled_buffer(making.gl, std::array{std::as_bytes(std::span(making.scene.triangles))});
    made->no_attributes = make_vertex_array(making.gl);
    made->quad_vertices = static_cast<GLsizei>(6 * edges.size());
    made->cap_vertices = static_cast<GLsizei>(3 * making.scene.triangles.size());
    made->quads = link_files(making.gl, {"degenerate_quads.vert", "volume.frag"});
    made->caps = link_files(making.gl, {"degenerate_caps.vert", "volume.frag"});
    for (const Program* program : {&made->quads, &made->caps})
        set_volume_transform(making.gl, *program, making.transform);
    making.gl.ProgramUniform1i(made->caps.name(), 9, made->cap_vertices);
    const auto update = [made, making] {
        set_light(making, made->quads);
        set_light(making, made->caps);
    };
    const auto draw_quads = [made, making](bool flipped) {
        const GlFunctions& gl = making.gl;
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, making.geometry.positions.name());
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, made->edges.name());
        gl.BindVertexArray(made->no_attributes.name());
        gl.ProgramUniform1i(made->quads.name(), 12, flipped ? 1 : 0);
        gl.UseProgram(made->quads.name());
        gl.DrawArrays(GL_TRIANGLES, 0, made->quad_vertices);
        gl.BindVertexArray(making.geometry.vertices.name());
    };
    const auto draw = [made, making, draw_quads] {
        draw_quads(false);
        const GlFunctions& gl = making.gl;
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, made->corners.name());
        gl.BindVertexArray(made->no_attributes.name());
        gl.UseProgram(made->caps.name());
        const GLsizei light = making.caps.light ? made->cap_vertices : 0;
        const GLsizei dark = making.caps.dark ? made->cap_vertices : 0;
        gl.DrawArrays(GL_TRIANGLES, made->cap_vertices - light, light + dark);
        gl.BindVertexArray(making.geometry.vertices.name());
    };
    return {.update = update,
            .draw = draw,
            .draw_flipped = [draw_quads] { draw_quads(true); },
            .programs = {made->quads.name(), made->caps.name()}};
}

} // namespace

void set_worth(const GlFunctions& gl, const VolumePass& pass, float front, float back) {
    // Location as volume.frag lays it out.
    for (const GLuint program : pass.programs) gl.ProgramUniform2f(program, 15, front, back);
}

VolumePass make_volume_pass(const GlFunctions& gl, const Scene& scene, const Geometry& geometry,
                            const ClipTransform& transform, const VolumeCaps& caps,
                            VolumeMaking making, Between surfaces, const Extruder& extruder) {
    const Making all{gl, scene, geometry, transform, caps};
    switch (making) {
    case VolumeMaking::on_cpu:
        break;
    case VolumeMaking::degenerate_quads:
        return degenerate_quads_pass(all);
    case VolumeMaking::geometry_shader:
        return geometry_shader_pass(all);
    }
    return cpu_pass(all, surfaces, extruder);
}

} // namespace shadowproof
