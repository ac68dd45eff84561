// Programs from the GLSL files of raster/glsl/, which are embedded at build time.
#pragma once

#include "raster/gl.h"

#include <string_view>

namespace shadowproof {

/// The text of a file of raster/glsl/ by its name; empty where there is none.
std::string_view glsl_source(std::string_view file);

struct ShaderText {
    std::string_view file; ///< for messages; its ending (.vert, .geom, .frag) is its stage
    std::string_view text;
};

/// Throws Error with the driver's log, each line of it led by "file:line".
Program link(const GlFunctions& gl, const ShaderText& vertex, const ShaderText& fragment);

/// The same from two files of raster/glsl/.
Program link_files(const GlFunctions& gl, std::string_view vertex, std::string_view fragment);

} // namespace shadowproof
