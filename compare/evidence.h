// Unexplained evidence of a technique: counters, surfaces, colours, and figures and pictures of its
// volumes. The one place that knows all kinds of evidence; judging and writing use it.
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
