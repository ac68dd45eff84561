// Which point of a benchmark is measured next: all in turn, round after round, so that a moment of
// noise affects all alike.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace shadowproof {

struct RoundLimits {
    std::size_t repeats = 50; ///< most samples of a point
    double seconds = 120;     ///< after which no sample is begun, but for the first of each point
};

/// What the rounds call. The clock is given, so that tests need none.
struct RoundCalls {
    /// One more sample of a point, milliseconds; none where it cannot be measured any more.
    std::function<std::optional<double>(std::size_t)> measure;
    std::function<double()> seconds;         ///< a steady clock
    std::function<void(std::size_t)> before; ///< a point is about to be measured
    std::function<void()> after_round;
};

/// A point whose last sample took longer waits until all quicker ones are done.
inline constexpr double patience = 1000; // milliseconds

/// Appends samples to those of each point until each is settled or a limit is reached. A settled
/// point is measured no more. Every second round goes backwards: no point always follows the same
/// other.
void measure_in_rounds(std::vector<std::vector<double>>& samples, const RoundLimits& limits,
                       const RoundCalls& calls);

/// Whether a point needs no further sample.
bool is_done(const std::vector<double>& samples, const RoundLimits& limits);

} // namespace shadowproof
