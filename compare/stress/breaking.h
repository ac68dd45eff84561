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

/// A value between one that holds and one that fails, of three digits, about as many times one as
/// the other is; none where they are within a tenth of each other, or nothing is between them. Zero
/// has nothing between itself and the nearest value that was tried.
std::optional<double> value_between(double holds, double fails, bool whole);

/// Each technique's breaking point, measured and derived, on one side of the scene's own value, as
/// far as the points tell. Points are in the order of values; techniques that fail at the own value
/// are left out. A value counts only up to the first that fails.
std::vector<Breaking> breaking_points(const StressAlong& along, bool up);

/// The value that tells most about the side's breaking points, none where all are near enough. With
/// the techniques that are to be tried there.
struct Search {
    double value = 0;
    std::vector<std::string> techniques{};
};
std::optional<Search> next_search(const std::vector<Breaking>& breaking, bool whole);

} // namespace shadowproof
