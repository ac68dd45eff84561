#include "raster/gl/gl.h"

#include "raster/gl/platform.h"
#include "scenes/error.h"

#include <string>

namespace shadowproof {

namespace {

template <class Function>
Function find(Platform& platform, const char* name) {
    const GlProcedure procedure = platform.find(name);
    if (!procedure)
        throw Error("OpenGL", std::string("the driver has no ") + name,
                    "it needs OpenGL 4.5 (Mesa 20 or later)");
    return reinterpret_cast<Function>(procedure);
}

const char* error_name(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    default:
        return "an error without a name";
    }
}

} // namespace

GlFunctions load_gl(Platform& platform) {
    GlFunctions gl;
#define SHADOWPROOF_LOAD(Type, name) gl.name = find<Type>(platform, "gl" #name);
    SHADOWPROOF_GL_FUNCTIONS(SHADOWPROOF_LOAD)
#undef SHADOWPROOF_LOAD
    return gl;
}

void check(const GlFunctions& gl, std::string_view what) {
    constexpr int most = 8; // a lost context may report errors endlessly
    const GLenum first = gl.GetError();
    for (int i = 0; i < most && gl.GetError() != GL_NO_ERROR; ++i) {
    }
    if (first != GL_NO_ERROR)
        throw Error("OpenGL", std::string(what) + " failed with " + error_name(first),
                    first == GL_OUT_OF_MEMORY ? "render a smaller picture or scene"
                                              : "report this: it is a bug of program or driver");
}

Buffer make_buffer(const GlFunctions& gl) {
    GLuint name = 0;
    gl.CreateBuffers(1, &name);
    return {gl, name};
}

Framebuffer make_framebuffer(const GlFunctions& gl) {
    GLuint name = 0;
    gl.CreateFramebuffers(1, &name);
    return {gl, name};
}

Query make_query(const GlFunctions& gl, GLenum target) {
    GLuint name = 0;
    gl.CreateQueries(target, 1, &name);
    return {gl, name};
}

Texture make_texture(const GlFunctions& gl, GLenum target) {
    GLuint name = 0;
    gl.CreateTextures(target, 1, &name);
    return {gl, name};
}

VertexArray make_vertex_array(const GlFunctions& gl) {
    GLuint name = 0;
    gl.CreateVertexArrays(1, &name);
    return {gl, name};
}

void set_enabled(const GlFunctions& gl, GLenum capability, bool enabled) {
    if (enabled)
        gl.Enable(capability);
    else
        gl.Disable(capability);
}

} // namespace shadowproof
