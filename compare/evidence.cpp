#include "compare/evidence.h"

#include "compare/words.h"

#include <fmt/format.h>

namespace shadowproof {

namespace {

std::string pixels_words(std::string_view what, std::uint64_t pixels, int x, int y) {
    return fmt::format("{} unexplained at {}, first ({},{})", what, counted(pixels, "pixel"), x, y);
}

} // namespace

std::vector<std::string> unexplained_evidence(const Comparison& comparison) {
    std::vector<std::string> clauses;
    const EvidenceCheck& evidence = comparison.evidence;
    if (evidence.unexplained > 0)
        clauses.push_back(pixels_words(comparison.evidence_name + " or surface",
                                       evidence.unexplained, evidence.first_x, evidence.first_y));
    if (const auto& colors = comparison.colors; colors && colors->unpredicted > 0)
        clauses.push_back(pixels_words("colour", colors->unpredicted, colors->first_unpredicted_x,
                                       colors->first_unpredicted_y));
    const std::vector<std::string>& more = comparison.summary.unexplained;
    clauses.insert(clauses.end(), more.begin(), more.end());
    return clauses;
}

bool is_explained(const Comparison& comparison) {
    return pixels_of(comparison, Cause::unexplained) == 0 &&
           unexplained_evidence(comparison).empty();
}

} // namespace shadowproof
