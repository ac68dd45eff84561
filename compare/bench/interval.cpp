#include "compare/bench/interval.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

namespace {

/// The largest r with P(fewer than r of n samples lie below the median) <= 2.5 %, at least 1: the
/// r-th smallest and r-th greatest are the ends.
std::size_t rank_of_ends(std::size_t n) {
    double probability = std::pow(0.5, static_cast<double>(n)); // that none lies below
    double below = probability;
    std::size_t rank = 1;
    for (std::size_t k = 1; k < n; ++k) {
        probability *= static_cast<double>(n - k + 1) / static_cast<double>(k);
        below += probability;
        if (below > 0.025) break;
        rank = k + 1;
    }
    return rank;
}

} // namespace

TimeInterval median_interval(std::vector<double> samples) {
    if (samples.empty()) return {};
    std::sort(samples.begin(), samples.end());
    const std::size_t n = samples.size();
    const double median = (samples[(n - 1) / 2] + samples[n / 2]) / 2;
    const bool is_known = n >= least_samples;
    const std::size_t rank = is_known ? rank_of_ends(n) : 1;
    return {median, samples[rank - 1], samples[n - rank], is_known};
}

bool is_settled(const std::vector<double>& samples) {
    const TimeInterval interval = median_interval(samples);
    return interval.is_known && interval.low >= 0.95 * interval.median &&
           interval.high <= 1.05 * interval.median;
}

bool is_surely_slower(const TimeInterval& slower, const TimeInterval& quicker) {
    return slower.is_known && quicker.is_known && slower.low > quicker.high;
}

} // namespace shadowproof
