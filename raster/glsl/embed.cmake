# Writes OUTPUT, a C++ file that holds the text of FILES behind glsl_source() of shader.h.
set(entries "")
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    string(APPEND entries "    if (file == \"${name}\") return R\"glsl(${text})glsl\";\n")
endforeach()
file(WRITE ${OUTPUT} "// Written by embed.cmake.
#include \"raster/shader.h\"

namespace shadowproof {

std::string_view glsl_source(std::string_view file) {
${entries}    return {};
}

} // namespace shadowproof
")
