// Programs from the GLSL files of raster/glsl/, which are embedded at build time.
#pragma once

#include "raster/gl/gl.h"

#include <initializer_list>
#include <span>
#include <string_view>

namespace shadowproof {

/// The text of a file of raster/glsl/ by its name, with what it includes; empty where there is
/// none.
std::string_view glsl_source(std::string_view file);

struct ShaderText {
    std::string_view file; ///< for messages; its ending (.vert, .geom, .frag) is its stage
    std::string_view text;
};

/// A file of raster/glsl/ by its name.
ShaderText shader_file(std::string_view name);

/// Links one text per stage. Throws Error with the driver's log, each line of it preceded by
/// "file:line".
Program link(const GlFunctions& gl, std::span<const ShaderText> stages);

/// The same with files of raster/glsl/.
Program link_files(const GlFunctions& gl, std::initializer_list<std::string_view> files);

} // namespace shadowproof
