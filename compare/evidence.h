// In words, which evidence of a claim is unexplained: values read back and surfaces shown, colours,
// and what its family adds (EvidenceSummary::unexplained). The verdict and all writers use these
// functions.
#pragma once

#include "compare/classify.h"

#include <string>
#include <vector>

namespace shadowproof {

/// A clause for each kind of evidence that is unexplained: "counter or surface unexplained at
/// 3 pixels, first (2,1)". None where all of it is explained.
std::vector<std::string> unexplained_evidence(const Comparison& comparison);

/// Whether each differing pixel has its cause, and all evidence is explained.
bool is_explained(const Comparison& comparison);

} // namespace shadowproof
