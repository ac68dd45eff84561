#include "compare/stress/stress_page.h"

#include "compare/report/report_template.h"

namespace shadowproof {

std::string stress_page() {
    std::string script;
    for (const char* name :
         {"elements.js", "numbers.js", "labels.js", "bench/figures.js", "bench/layout.js",
          "bench/plot.js", "stress/chart.js", "stress/page.js"})
        script += viewer_file(name);
    return fill(viewer_file("stress/page.html"),
                {{"style", std::string(viewer_file("style.css")) +
                               std::string(viewer_file("stress/style.css"))},
                 {"script", script}});
}

std::string stress_script(const std::string& stress_json) {
    return "shadowproofStress(" + stress_json + ");\n";
}

} // namespace shadowproof
