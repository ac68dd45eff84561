// Finds breaking points by bisection.
#pragma once

#include "compare/stress/stress_run.h"
#include "scenes/stress/parameter.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowproof {

/// "refused", or a loss's name.
std::string refusal(Loss loss);

/// The geometric mean of a value that holds and one that fails, rounded to three digits, or to a
/// whole number; none where they are within a tenth of each other, where it is not between them, or
/// where one of them is zero.
std::optional<double> value_between(double holds, double fails, bool whole);

/// Each technique's breaking point, measured and derived, on one side of the scene's own value, as
/// far as the points tell. Points are in the order of values; techniques that fail at the own value
/// are left out. A value counts only up to the first that fails.
std::vector<Breaking> breaking_points(const StressAlong& along, bool up);

/// The next value to try in search of the side's breaking points, with the techniques to be tried
/// there; none where all are known well enough.
struct Search {
    double value = 0;
    std::vector<std::string> techniques{};
};
std::optional<Search> next_search(const std::vector<Breaking>& breaking, bool whole);

} // namespace shadowproof
