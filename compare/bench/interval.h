// The median of measured times and how well it is known.
#pragma once

#include <cstddef>
#include <vector>

namespace shadowproof {

/// Milliseconds.
struct TimeInterval {
    double median = 0;
    double low = 0;
    double high = 0;
};

/// Fewer samples give no interval of 95 %: the least and the greatest of five hold the median
/// between them in 15 of 16 cases.
inline constexpr std::size_t least_samples = 6;

/// The sample median and the order statistics that hold the true median between them in 95 % of
/// cases, whatever the distribution (the sign test's interval; Conover 1999, section 3.2). It takes
/// samples for independent. Of fewer than least_samples: the least and the greatest. Of none: zero.
TimeInterval median_interval(std::vector<double> samples);

/// Whether there are enough samples and both ends lie within 5 % of the median.
bool is_settled(const std::vector<double>& samples);

} // namespace shadowproof
