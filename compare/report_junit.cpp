#include "compare/report.h"
#include "compare/report_template.h"

#include <fmt/format.h>

#include <algorithm>

namespace shadowproof {

namespace {

std::string element(std::string_view name, std::string_view type, const std::string& message) {
    return fmt::format("      <{} type=\"{}\" message=\"{}\"/>\n", name, type, escaped(message));
}

std::string case_of(const Report& report, const SceneResult& scene, const Cell& cell) {
    std::string body;
    if (!cell.error.empty()) {
        body = element("error", "could_not_run", cell.error);
    } else if (fails(cell, report.gate)) {
        const Comparison& comparison = cell.comparison;
        std::string message =
            comparison.differing == 0 ? "no pixel of the claim differs" : cause_counts(comparison);
        if (comparison.first)
            message += fmt::format("; first ({},{}) {}", comparison.first->x, comparison.first->y,
                                   name_of(comparison.first->cause));
        if (comparison.ledger.unexplained > 0)
            message += fmt::format("; counter unexplained at {} pixels",
                                   grouped(comparison.ledger.unexplained));
        body = element("failure", name_of(cell.verdict),
                       message + "; reproduce: " + reproducing_command(report, scene, cell));
    }
    return fmt::format("    <testcase classname=\"shadowproof.{}\" name=\"{}\" time=\"{:.6f}\"{}\n",
                       escaped(scene.name), escaped(cell.technique), cell.milliseconds / 1000,
                       body.empty() ? "/>" : ">\n" + body + "    </testcase>");
}

struct Suite {
    std::size_t tests = 0;
    std::size_t failures = 0;
    std::size_t errors = 0;
    std::string cases;
};

Suite suite_of(const Report& report, const SceneResult& scene) {
    Suite suite;
    // What concerns the scene as a whole is a case of its own.
    if (!scene.error.empty() || !scene.no_longer_provoked.empty()) {
        ++(scene.error.empty() ? suite.failures : suite.errors);
        ++suite.tests;
        std::string causes;
        for (const std::string& cause : scene.no_longer_provoked)
            causes += (causes.empty() ? "" : ", ") + cause;
        suite.cases += fmt::format(
            "    <testcase classname=\"shadowproof.{0}\" name=\"scene\" time=\"0\">\n{1}"
            "    </testcase>\n",
            escaped(scene.name),
            scene.error.empty()
                ? element("failure", "no_longer_provoked", "the scene no longer provokes " + causes)
                : element("error", "could_not_run", scene.error));
    }
    for (const Cell& cell : scene.cells) {
        ++suite.tests;
        if (!cell.error.empty()) {
            ++suite.errors;
        } else if (fails(cell, report.gate)) {
            ++suite.failures;
        }
        suite.cases += case_of(report, scene, cell);
    }
    return suite;
}

} // namespace

std::string to_junit(const Report& report) {
    Suite all;
    for (const SceneResult& scene : report.scenes) {
        const Suite suite = suite_of(report, scene);
        all.tests += suite.tests;
        all.failures += suite.failures;
        all.errors += suite.errors;
        all.cases += fmt::format(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}"
            "  </testsuite>\n",
            escaped(scene.name), suite.tests, suite.failures, suite.errors, suite.cases);
    }
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<testsuites name=\"shadowproof\" tests=\"{}\" failures=\"{}\" "
                       "errors=\"{}\">\n{}</testsuites>\n",
                       all.tests, all.failures, all.errors, all.cases);
}

} // namespace shadowproof
