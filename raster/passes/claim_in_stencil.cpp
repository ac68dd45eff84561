#include "raster/passes/claim_in_stencil.h"

#include <array>

namespace shadowproof {

Program link_not_lit(const GlFunctions& gl) {
    const std::array stages{shader_file("whole_picture.vert"), shader_file("not_lit.frag")};
    return link(gl, stages);
}

void keep_claim_in_stencil(const GlFunctions& gl, const Program& not_lit, const Target& target) {
    constexpr GLint light = 0;
    constexpr GLint shadow = 1;
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.lighting.name());
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilMask(~0U);
    gl.ClearNamedFramebufferiv(target.lighting.name(), GL_STENCIL, 0, &light);
    gl.StencilFunc(GL_ALWAYS, shadow, ~0U);
    gl.StencilOp(GL_REPLACE, GL_REPLACE, GL_REPLACE);
    gl.UseProgram(not_lit.name());
    gl.BindTextureUnit(0, target.claim.name());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Enable(GL_DEPTH_TEST);
    check(gl, "keeping a claim in the stencil");
}

} // namespace shadowproof
