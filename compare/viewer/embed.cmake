# Writes OUTPUT, a C++ source whose viewer_file() returns the text of each of FILES, named relative to
# FOLDER; and whose viewer_script() and viewer_style() return those that end in .js and .css, one after
# the other, without those of the pages of bench and stress.
set(cases "")
set(scripts "")
set(styles "")
foreach(name ${FILES})
    file(READ ${FOLDER}/${name} text)
    string(APPEND cases "    if (name == \"${name}\")\n        return R\"viewer(${text})viewer\";\n")
    if(name MATCHES "^(bench|stress)/")
        continue()
    elseif(name MATCHES "\\.js$")
        string(APPEND scripts "    script += viewer_file(\"${name}\");\n")
    elseif(name MATCHES "\\.css$")
        string(APPEND styles "    style += viewer_file(\"${name}\");\n")
    endif()
endforeach()
file(WRITE ${OUTPUT} "// Made by compare/viewer/embed.cmake.
#include \"compare/report/report_template.h\"

#include <cassert>

namespace shadowproof {

std::string_view viewer_file(std::string_view name) {
${cases}    assert(false && \"no such file in compare/viewer\");
    return {};
}

std::string viewer_script() {
    std::string script;
${scripts}    return script;
}

std::string viewer_style() {
    std::string style;
${styles}    return style;
}

} // namespace shadowproof
")
