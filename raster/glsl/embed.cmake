# Writes OUTPUT, a C++ file that holds the text of FILES behind glsl_source() of shader.h. A file's
# name is unique among those of all folders.
set(entries "")
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    if(DEFINED path_of_${name})
        message(FATAL_ERROR "${file}: has the name of ${path_of_${name}}")
    endif()
    set(path_of_${name} ${file})
endforeach()
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    # A line "#include NAME" is replaced by the file of that name.
    while(text MATCHES "#include ([a-z_.]+)\n")
        set(included ${CMAKE_MATCH_1})
        file(READ ${path_of_${included}} body)
        string(REPLACE "#include ${included}\n" "${body}" text "${text}")
    endwhile()
    string(APPEND entries "    if (file == \"${name}\") return R\"glsl(${text})glsl\";\n")
endforeach()
file(WRITE ${OUTPUT} "// Written by embed.cmake.
#include \"raster/gl/shader.h\"

namespace shadowproof {

std::string_view glsl_source(std::string_view file) {
${entries}    return {};
}

} // namespace shadowproof
")
