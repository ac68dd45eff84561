#include "raster/gl/shader.h"

#include "scenes/error.h"

#include <cassert>
#include <sstream>
#include <string>
#include <vector>

namespace shadowproof {

namespace {

GLenum stage_of(std::string_view file) {
    if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
    if (file.ends_with(".geom")) return GL_GEOMETRY_SHADER;
    assert(file.ends_with(".frag"));
    return GL_FRAGMENT_SHADER;
}

/// Mesa begins a line with "0:12(5)", NVIDIA with "0(12)", where 0 is the only source string.
/// Replaces them by "file:12(5)" and "file:12".
std::string name_lines(const std::string& log, std::string_view file) {
    std::string named;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t close = line.find(')');
        if (!named.empty()) named += '\n';
        if (line.starts_with("0:"))
            named += std::string(file) + line.substr(1);
        else if (line.starts_with("0(") && close != std::string::npos)
            named += std::string(file) + ':' + line.substr(2, close - 2) + line.substr(close + 1);
        else
            named += line;
    }
    return named;
}

std::string without_last_newline(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.pop_back();
    return text;
}

Shader compile(const GlFunctions& gl, const ShaderText& source) {
    Shader shader(gl, gl.CreateShader(stage_of(source.file)));
    const GLchar* const text = source.text.data();
    const auto length = static_cast<GLint>(source.text.size());
    gl.ShaderSource(shader.name(), 1, &text, &length);
    gl.CompileShader(shader.name());
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled) return shader;

    GLint size = 0;
    gl.GetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &size);
    std::string log(static_cast<std::size_t>(size), '\0');
    gl.GetShaderInfoLog(shader.name(), size, nullptr, log.data());
    throw Error(std::string(source.file),
                "does not compile: " + name_lines(without_last_newline(log), source.file),
                "correct the shader");
}

} // namespace

ShaderText shader_file(std::string_view name) {
    assert(!glsl_source(name).empty());
    return {name, glsl_source(name)};
}

Program link(const GlFunctions& gl, std::span<const ShaderText> stages) {
    Program program(gl, gl.CreateProgram());
    std::vector<Shader> shaders;
    std::string files;
    for (const ShaderText& stage : stages) {
        shaders.push_back(compile(gl, stage));
        gl.AttachShader(program.name(), shaders.back().name());
        files += (files.empty() ? "" : " and ") + std::string(stage.file);
    }
    gl.LinkProgram(program.name());
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked) return program;

    GLint size = 0;
    gl.GetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &size);
    std::string log(static_cast<std::size_t>(size), '\0');
    gl.GetProgramInfoLog(program.name(), size, nullptr, log.data());
    throw Error(files, "do not link: " + without_last_newline(log), "correct the shaders");
}

Program link_files(const GlFunctions& gl, std::initializer_list<std::string_view> files) {
    std::vector<ShaderText> stages;
    for (const std::string_view file : files) stages.push_back(shader_file(file));
    return link(gl, std::span<const ShaderText>(stages));
}

} // namespace shadowproof
