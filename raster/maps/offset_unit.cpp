#include "raster/maps/offset_unit.h"

#include "raster/gl/shader.h"
#include "raster/maps/map_pass.h"

#include <cmath>

namespace shadowproof {

// So many units that they come to some part of a 16th of all depths, so that the two steps by which
// reading both depths is off tell little. The triangle's depth stays below 1 for units of up to
// eight steps.
OffsetUnit measured_offset_unit(const GlFunctions& gl, MapFormat format) {
    const DepthFormat stored = depth_format_of(format);
    if (stored.floating) return {};
    const Texture texture = make_texture(gl, GL_TEXTURE_2D);
    gl.TextureStorage2D(texture.name(), 1, gl_format(format), 1, 1);
    const Framebuffer framebuffer = make_framebuffer(gl);
    gl.NamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, texture.name(), 0);
    const VertexArray nothing = make_vertex_array(gl);
    const Program program = link_files(gl, {"offset_unit.vert", "map_depth.frag"});
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.Viewport(0, 0, 1, 1);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_STENCIL_TEST);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_ALWAYS);
    gl.DepthMask(GL_TRUE);
    gl.BindVertexArray(nothing.name());
    gl.UseProgram(program.name());
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    const auto depth_with = [&](double units) {
        gl.PolygonOffset(0, static_cast<GLfloat>(units));
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        GLfloat depth = 0;
        gl.ReadPixels(0, 0, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
        return double{depth};
    };
    const double units = std::exp2(stored.bits - 4);
    const double moved = depth_with(units) - depth_with(0);
    gl.Disable(GL_POLYGON_OFFSET_FILL);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    check(gl, "measuring the polygon offset");
    const double off = 2 * std::exp2(-stored.bits);
    return {(moved - off) / units, (moved + off) / units};
}

} // namespace shadowproof
