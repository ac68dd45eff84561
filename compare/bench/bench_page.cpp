#include "compare/bench/bench_page.h"

#include "compare/report/report_template.h"

namespace shadowproof {

std::string bench_page() {
    std::string script;
    for (const char* name :
         {"elements.js", "numbers.js", "labels.js", "bench/figures.js", "bench/layout.js",
          "bench/plot.js", "bench/growth_layout.js", "bench/growth.js", "bench/page.js"})
        script += viewer_file(name);
    return fill(viewer_file("bench/page.html"),
                {{"style", std::string(viewer_file("style.css")) +
                               std::string(viewer_file("bench/style.css"))},
                 {"script", script}});
}

std::string bench_script(const std::string& bench_json, const std::string& older_json) {
    return "shadowproofBench(" + bench_json + ",\n" + (older_json.empty() ? "null" : older_json) +
           ");\n";
}

} // namespace shadowproof
