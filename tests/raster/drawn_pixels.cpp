#include "tests/raster/drawn_pixels.h"

#include "raster/gl/context.h"
#include "raster/gl/shader.h"

#include <array>

namespace shadowproof::tests {

Picture make_picture(const GlFunctions& gl, GLenum format, int width, int height) {
    Picture picture{width, height, make_texture(gl, GL_TEXTURE_2D), make_framebuffer(gl)};
    gl.TextureStorage2D(picture.texture.name(), 1, format, width, height);
    gl.NamedFramebufferTexture(picture.framebuffer.name(), GL_COLOR_ATTACHMENT0,
                               picture.texture.name(), 0);
    return picture;
}

void draw_pixels(const GlFunctions& gl, const Picture& picture, const std::string& fragment) {
    constexpr std::string_view one_triangle =
        "#version 450 core\n"
        "void main() {\n"
        "    gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);\n"
        "}\n";
    const std::string text = "#version 450 core\n" + fragment;
    const Program program = link(gl, std::array{ShaderText{"one_triangle.vert", one_triangle},
                                                ShaderText{"pixels.frag", text}});
    const VertexArray nothing = make_vertex_array(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer.name());
    gl.Viewport(0, 0, picture.width, picture.height);
    gl.UseProgram(program.name());
    gl.BindVertexArray(nothing.name());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.BindVertexArray(0);
    check(gl, "drawing pixels");
}

double red_steps_of(const std::string& expression, const std::string& file) {
    const Gpu gpu(GlPlatform::osmesa);
    const GlFunctions& gl = gpu.gl();
    const Picture picture = make_picture(gl, GL_R32F, 1, 1);
    draw_pixels(gl, picture,
                std::string(glsl_source(file)) +
                    "layout(location = 0) out float result;\n"
                    "const vec3 z = vec3(0, 0, 1);\n"
                    "void main() { result = (" +
                    expression + ").r; }\n");
    float result = 0;
    gl.ReadPixels(0, 0, 1, 1, GL_RED, GL_FLOAT, &result);
    return 255.0 * result;
}

} // namespace shadowproof::tests
