// What stress finds as lines for the console.
#pragma once

#include "compare/stress/stress_run.h"

#include <string>
#include <vector>

namespace shadowproof {

/// A parameter's breaking points, earliest first; techniques that break alike share a line. Then
/// those that hold, and those that were wrong before.
std::vector<std::string> stress_table(const StressAlong& along);

/// "1e-06", "0", "12": as --stress takes it.
std::string value_words(double value);

} // namespace shadowproof
