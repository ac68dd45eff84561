#include "compare/bench/rounds.h"

#include "compare/bench/interval.h"

namespace shadowproof {

bool is_done(const std::vector<double>& samples, const RoundLimits& limits) {
    return samples.size() >= limits.repeats || is_settled(samples);
}

void measure_in_rounds(std::vector<std::vector<double>>& samples, const RoundLimits& limits,
                       const RoundCalls& calls) {
    const double start = calls.seconds();
    std::vector<bool> lost(samples.size());
    const auto is_slow = [&](std::size_t point) {
        return !samples[point].empty() && samples[point].back() > patience;
    };
    const auto is_open = [&](std::size_t point) {
        return !lost[point] && !is_done(samples[point], limits);
    };
    const auto waits = [&](std::size_t point) {
        if (!is_slow(point)) return false;
        for (std::size_t other = 0; other < samples.size(); ++other)
            if (is_open(other) && !is_slow(other)) return true;
        return false;
    };
    const auto has_time = [&] { return calls.seconds() - start < limits.seconds; };
    for (bool backwards = false, measured = true; measured; backwards = !backwards) {
        measured = false;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const std::size_t point = backwards ? samples.size() - 1 - k : k;
            if (!is_open(point) || waits(point)) continue;
            if (!samples[point].empty() && !has_time()) continue;
            calls.before(point);
            measured = true;
            if (const std::optional<double> sample = calls.measure(point))
                samples[point].push_back(*sample);
            else
                lost[point] = true;
        }
        if (measured) calls.after_round();
    }
}

} // namespace shadowproof
