#include "compare/report/escape.h"
#include "compare/report/report.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace shadowproof {

namespace {

struct Suite {
    std::size_t tests = 0;
    std::size_t failures = 0;
    std::size_t errors = 0;
    double seconds = 0;
    std::string cases;
    std::string lines; ///< as the console prints them
};

struct Outcome {
    std::string element; ///< failure or error; empty: passed
    std::string type;
    std::string message;
    std::string reproduce;
};

void add_case(Suite& suite, const std::string& scene, std::string_view name, double seconds,
              const Outcome& outcome) {
    ++suite.tests;
    suite.seconds += seconds;
    if (outcome.element == "failure") ++suite.failures;
    if (outcome.element == "error") ++suite.errors;
    suite.cases +=
        fmt::format("      <testcase classname=\"shadowproof.{}\" name=\"{}\" time=\"{:.6f}\"",
                    escaped(scene), escaped(name), seconds);
    if (outcome.element.empty()) {
        suite.cases += "/>\n";
        return;
    }
    suite.cases += fmt::format(
        ">\n        <{0} type=\"{1}\" message=\"{2}\">{2}\n{3}</{0}>\n      </testcase>\n",
        outcome.element, outcome.type, escaped(outcome.message),
        escaped("reproduce: " + outcome.reproduce));
}

Outcome outcome_of(const Report& report, const SceneResult& scene, const Cell& cell) {
    if (!fails(cell, report.gate)) return {};
    const bool ran = !could_not_run(cell);
    return {.element = ran ? "failure" : "error",
            .type = std::string(ran ? name_of(cell.verdict) : "could_not_run"),
            .message = why_it_fails(cell, report.gate),
            .reproduce = reproducing_command(report, scene, cell)};
}

/// Of a cell that failed, the pictures that tell why: absolute, in the report's folder.
std::vector<std::pair<std::string, std::string>> pictures_of(const Report& report,
                                                             const SceneResult& scene,
                                                             const Cell& cell,
                                                             const std::filesystem::path& folder) {
    std::vector<std::pair<std::string, std::string>> pictures;
    if (folder.empty() || !cell.error.empty() || !fails(cell, report.gate)) return pictures;
    for (const char* kind : {"claim", "difference", "cause"})
        pictures.emplace_back(
            kind, (std::filesystem::absolute(folder) / picture_path(scene, cell, kind)).string());
    return pictures;
}

Suite suite_of(const Report& report, const SceneResult& scene,
               const std::filesystem::path& folder) {
    Suite suite;
    // What concerns the whole scene is a case of its own.
    if (!scene.error.empty())
        add_case(suite, scene.name, "scene", 0,
                 {"error", "could_not_run", scene.error, reproducing_command(report, scene)});
    if (!scene.no_longer_provoked.empty())
        add_case(suite, scene.name, "scene", 0,
                 {"failure", "no_longer_provoked", no_longer_provoked_words(scene),
                  reproducing_command(report, scene)});
    for (const Cell& cell : scene.cells) {
        add_case(suite, scene.name, cell.technique, cell.milliseconds / 1000,
                 outcome_of(report, scene, cell));
        suite.lines += cell_line(scene, cell) + "\n";
        // As Jenkins' plugin for attachments and GitLab read them.
        for (const auto& [kind, file] : pictures_of(report, scene, cell, folder))
            suite.lines += fmt::format("[[ATTACHMENT|{}]]\n", file);
    }
    return suite;
}

std::string properties_of(const Report& report, const SceneResult& scene) {
    std::string allowed;
    for (const Allowance& allowance : report.gate.allow)
        allowed += (allowed.empty() ? "" : ",") + words_of(allowance);
    std::string properties;
    const auto add = [&](std::string_view name, std::string_view value) {
        properties +=
            fmt::format("        <property name=\"{}\" value=\"{}\"/>\n", name, escaped(value));
    };
    add("file", scene.file);
    add("size", fmt::format("{}x{}", scene.width, scene.height));
    add("version", report.version);
    add("gl.version", report.gl.version);
    add("gl.renderer", report.gl.renderer);
    add("embree", report.embree);
    add("gate", name_of(report.gate.on));
    add("allow", allowed);
    if (report.baseline) add("baseline", report.baseline->file);
    return properties;
}

} // namespace

std::string to_junit(const Report& report, const std::string& timestamp,
                     const std::filesystem::path& folder) {
    // Ant's schema gives <testsuites> no attributes: readers add up the sums.
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
    int id = 0;
    for (const SceneResult& scene : report.scenes) {
        const Suite suite = suite_of(report, scene, folder);
        xml += fmt::format("    <testsuite id=\"{}\" package=\"shadowproof\" name=\"{}\" "
                           "timestamp=\"{}\" hostname=\"localhost\" tests=\"{}\" failures=\"{}\" "
                           "errors=\"{}\" time=\"{:.6f}\">\n      <properties>\n{}"
                           "      </properties>\n{}      <system-out>{}</system-out>\n"
                           "      <system-err></system-err>\n    </testsuite>\n",
                           id++, escaped(scene.name), timestamp, suite.tests, suite.failures,
                           suite.errors, suite.seconds, properties_of(report, scene), suite.cases,
                           escaped(suite.lines));
    }
    return xml + "</testsuites>\n";
}

std::string to_ctest_measurements(const Report& report, const std::filesystem::path& folder) {
    std::string lines;
    for (const SceneResult& scene : report.scenes)
        for (const Cell& cell : scene.cells)
            for (const auto& [kind, file] : pictures_of(report, scene, cell, folder))
                lines +=
                    fmt::format("<CTestMeasurementFile type=\"image/png\" name=\"{} on {}: {}\">"
                                "{}</CTestMeasurementFile>\n",
                                escaped(cell.technique), escaped(scene.name), kind, escaped(file));
    return lines;
}

} // namespace shadowproof
